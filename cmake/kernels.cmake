# Shaders: every .comp, .vert, .frag under src/<folder> becomes SPIR-V embedded in the program as one KernelCode.
#   src/passes/gbuffer/gbuffer.vert -> #include "kernels/passes/gbuffer/gbuffer.vert.h", kernels::gbuffer_gbuffer_vert
# SPIR-V 1.5: 1.6 writes workgroup sizes in a form that needs maintenance4. Names of variables are kept (no -O): the
# frame graph binds by name, and drivers optimise anyway.
function(lightwell_kernels target folder)
  file(GLOB_RECURSE shaders CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
    ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/kernels)
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_BINARY_DIR})
  foreach(shader IN LISTS shaders)
    string(REGEX REPLACE "^${folder}/" "" inner ${shader})
    string(REGEX REPLACE "[/.]" "_" symbol ${inner})
    get_filename_component(out_folder ${out}/${shader} DIRECTORY)
    file(MAKE_DIRECTORY ${out_folder})
    add_custom_command(
      OUTPUT ${out}/${shader}.inc
      COMMAND ${GLSLC} --target-env=vulkan1.2 -Werror -I ${CMAKE_CURRENT_SOURCE_DIR} -mfmt=num
              -MD -MF ${out}/${shader}.d ${CMAKE_CURRENT_SOURCE_DIR}/${shader} -o ${out}/${shader}.inc
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${shader}
      DEPFILE ${out}/${shader}.d
      COMMENT "glslc ${shader}" VERBATIM)
    file(CONFIGURE OUTPUT ${out}/${shader}.h CONTENT [[
#pragma once
#include "gpu/kernel_code.h"
namespace lightwell::kernels {
extern const KernelCode @symbol@;
}
]] @ONLY)
    file(CONFIGURE OUTPUT ${out}/${shader}.cpp CONTENT [[
#include "kernels/@shader@.h"
namespace lightwell::kernels {
namespace {
constexpr std::uint32_t kWords[] = {
#include "kernels/@shader@.inc"
};
}
const KernelCode @symbol@{"@shader@", kWords};
}
]] @ONLY)
    set_source_files_properties(${out}/${shader}.cpp PROPERTIES OBJECT_DEPENDS ${out}/${shader}.inc)
    target_sources(${target} PRIVATE ${out}/${shader}.cpp)
  endforeach()
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
