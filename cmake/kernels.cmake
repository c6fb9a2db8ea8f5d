# Shaders: every .comp, .vert, .frag under src/<folder> becomes SPIR-V embedded in the program as one KernelCode.
#   src/passes/gbuffer/gbuffer.vert -> #include "kernels/passes/gbuffer/gbuffer.vert.h", kernels::gbuffer_gbuffer_vert
# Kernels that include shaders/trace.glsl themselves are compiled twice, with LW_RAY_QUERY 0 and 1, into one TraceKernel.
# SPIR-V 1.5: 1.6 writes workgroup sizes in a form that needs maintenance4. Names of variables are kept (no -O): the
# frame graph binds by name, and drivers optimise anyway.
function(lightwell_kernels target folder)
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
    ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_BINARY_DIR})
  foreach(shader IN LISTS shaders)
    string(REGEX REPLACE "^${folder}/" "" inner ${shader})
    string(REGEX REPLACE "[/.]" "_" symbol ${inner})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shader})
    file(STRINGS ${shader} traces REGEX "^#include \"shaders/trace.glsl\"")
    if(traces)
      lightwell_compile_kernel(${target} ${shader} bvh -DLW_RAY_QUERY=0)
      lightwell_compile_kernel(${target} ${shader} ray_query -DLW_RAY_QUERY=1)
      set(type TraceKernel)
      set(words "constexpr std::uint32_t kBvh[] = {\n#include \"kernels/${shader}.bvh.inc\"\n};
constexpr std::uint32_t kRayQuery[] = {\n#include \"kernels/${shader}.ray_query.inc\"\n};")
      set(value "{\"${shader}\", kBvh}, {\"${shader} (ray queries)\", kRayQuery}")
    else()
      lightwell_compile_kernel(${target} ${shader} words)
      set(type KernelCode)
      set(words "constexpr std::uint32_t kWords[] = {\n#include \"kernels/${shader}.words.inc\"\n};")
      set(value "\"${shader}\", kWords")
    endif()
    set(out ${CMAKE_CURRENT_BINARY_DIR}/kernels/${shader})
    file(CONFIGURE OUTPUT ${out}.h CONTENT [[
#pragma once
#include "gpu/kernel_code.h"
namespace lightwell::kernels {
extern const @type@ @symbol@;
}
]] @ONLY)
    file(CONFIGURE OUTPUT ${out}.cpp CONTENT [[
#include "kernels/@shader@.h"
namespace lightwell::kernels {
namespace {
@words@
}
const @type@ @symbol@{@value@};
}
]] @ONLY)
    target_sources(${target} PRIVATE ${out}.cpp)
  endforeach()
endfunction()

# One variant of a kernel: kernels/<shader>.<variant>.inc, words of SPIR-V.
function(lightwell_compile_kernel target shader variant)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/kernels/${shader})
  get_filename_component(out_folder ${out} DIRECTORY)
  file(MAKE_DIRECTORY ${out_folder})
  add_custom_command(
    OUTPUT ${out}.${variant}.inc
    COMMAND ${GLSLC} --target-env=vulkan1.2 -Werror -I ${CMAKE_CURRENT_SOURCE_DIR} -mfmt=num ${ARGN}
            -MD -MF ${out}.${variant}.d ${CMAKE_CURRENT_SOURCE_DIR}/${shader} -o ${out}.${variant}.inc
    DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${shader}
    DEPFILE ${out}.${variant}.d
    COMMENT "glslc ${shader} ${ARGN}" VERBATIM)
  set_property(SOURCE ${out}.cpp APPEND PROPERTY OBJECT_DEPENDS ${out}.${variant}.inc)
endfunction()

# The table of techniques: one row for each folder of src/<folder> that holds a <name>.cpp defining kTechnique_<name>.
function(lightwell_technique_table target folder)
  file(GLOB sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/${folder} ${folder}/*/*.cpp)
  set(declarations "")
  set(rows "")
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(technique ${source} DIRECTORY)
    if(name STREQUAL technique)
      string(APPEND declarations "extern const TechniqueInfo kTechnique_${name};\n")
      string(APPEND rows "      &kTechnique_${name},\n")
    endif()
  endforeach()
  set(LIGHTWELL_DECLARATIONS ${declarations})
  set(LIGHTWELL_ROWS ${rows})
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/technique_table.cpp CONTENT [[
// Made by cmake/kernels.cmake from the folders of src/techniques.
#include "techniques/technique.h"
namespace lightwell {
@LIGHTWELL_DECLARATIONS@
std::span<const TechniqueInfo* const> techniques() {
  static const std::vector<const TechniqueInfo*> all = {
@LIGHTWELL_ROWS@  };
  return all;
}
}
]] @ONLY)
  target_sources(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/technique_table.cpp)
endfunction()
