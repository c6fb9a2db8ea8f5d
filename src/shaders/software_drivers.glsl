// What software drivers make of control flow, so that no kernel has to say it.
//
// Mesa's llvmpipe runs neighbouring invocations as the lanes of one vector and masks those that are not concerned:
// * Straight code in an `if` is run, masked, even where no lane wants it; a loop ends when no lane is left in it.
// * Behind the exit of a loop the rest of its body is run once more, masked: long loops test at their end.
// * Arrays that are indexed at run time, and many branches, take seconds to compile.
#ifndef LIGHTWELL_SOFTWARE_DRIVERS_GLSL
#define LIGHTWELL_SOFTWARE_DRIVERS_GLSL

// Bound of a loop that is run only under a condition, which the loop must not change. An `if` round a loop with a
// constant bound, which drivers unroll, means the same. Mesa 22.3.6, LLVM 15, 256 bits, `lightwell bench cornell-box
// --technique none --size 256x256`: a frame takes 51.7 ms of CPU time with this in the noise filter, 55.4 ms with ifs.
// Round a single call, such as a shadow ray or the look-up of a texture, it gains nothing.
#define LW_ROUNDS_IF(condition, rounds) ((condition) ? (rounds) : 0)

#endif
