// Storage buffers that may be longer than one descriptor reaches (maxStorageBufferRange, at least 128 MiB), behind one
// accessor. They are bound in pages of a power of two of elements (graph/pages.h); the graph sets how many there are. A
// pipeline for one page holds no trace of the others. Out of bounds as anywhere with robustBufferAccess: reads give
// something, writes go nowhere or into the same buffer.
//
//   LW_PAGED_READ(0, 2, uvec2, keys)                  // readonly: keys_at(i), keys_count()
//   LW_PAGED_WRITE(0, 3, uvec2, sorted)               // writeonly: sorted_store(i, element)
//   LW_PAGED_READ_WRITE(coherent, 0, 1, uint, marks)  // all of them; coherent, or restrict
#ifndef LIGHTWELL_PAGED_BUFFER_GLSL
#define LIGHTWELL_PAGED_BUFFER_GLSL

#define LW_PAGED_BLOCK(qualifier, set_number, binding_number, Type, name)                                \
  layout(constant_id = 32 + 32 * set_number + 2 * binding_number) const uint kPages_##name = 1;          \
  layout(constant_id = 33 + 32 * set_number + 2 * binding_number) const uint kPageShift_##name = 31;     \
  layout(set = set_number, binding = binding_number) qualifier buffer name##Block { Type data[]; } name[4]; \
  uint name##_page(uint index) { return index >> kPageShift_##name; }                                    \
  uint name##_place(uint index) { return index & ((1u << kPageShift_##name) - 1u); }

// Pages side by side rather than one after the other behind else: software drivers run all of them in any case.
#define LW_PAGED_AT(Type, name)                                                             \
  uint name##_count() {                                                                     \
    uint count = uint(name[0].data.length());                                               \
    if (kPages_##name > 1) count += uint(name[1].data.length());                            \
    if (kPages_##name > 2) count += uint(name[2].data.length());                            \
    if (kPages_##name > 3) count += uint(name[3].data.length());                            \
    return count;                                                                           \
  }                                                                                         \
  Type name##_at(uint index) {                                                              \
    if (kPages_##name == 1) return name[0].data[index];                                     \
    uint page = name##_page(index);                                                         \
    uint place = name##_place(index);                                                       \
    Type element = name[0].data[place];                                                     \
    if (page == 1) element = name[1].data[place];                                           \
    if (kPages_##name > 2 && page == 2) element = name[2].data[place];                      \
    if (kPages_##name > 3 && page == 3) element = name[3].data[place];                      \
    return element;                                                                         \
  }

#define LW_PAGED_STORE(Type, name)                                                          \
  void name##_store(uint index, Type element) {                                             \
    if (kPages_##name == 1) {                                                               \
      name[0].data[index] = element;                                                        \
      return;                                                                               \
    }                                                                                       \
    uint page = name##_page(index);                                                         \
    uint place = name##_place(index);                                                       \
    if (page == 0) name[0].data[place] = element;                                           \
    if (page == 1) name[1].data[place] = element;                                           \
    if (kPages_##name > 2 && page == 2) name[2].data[place] = element;                      \
    if (kPages_##name > 3 && page == 3) name[3].data[place] = element;                      \
  }

#define LW_PAGED_READ(set_number, binding_number, Type, name)       \
  LW_PAGED_BLOCK(readonly, set_number, binding_number, Type, name)  \
  LW_PAGED_AT(Type, name)

#define LW_PAGED_WRITE(set_number, binding_number, Type, name)      \
  LW_PAGED_BLOCK(writeonly, set_number, binding_number, Type, name) \
  LW_PAGED_STORE(Type, name)

#define LW_PAGED_READ_WRITE(qualifier, set_number, binding_number, Type, name) \
  LW_PAGED_BLOCK(qualifier, set_number, binding_number, Type, name)            \
  LW_PAGED_AT(Type, name)                                                      \
  LW_PAGED_STORE(Type, name)

#endif
