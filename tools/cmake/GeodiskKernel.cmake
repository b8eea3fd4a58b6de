# geodisk_add_kernel(TARGET NAME VARIANT [OPTIMIZED] [OPTION...]): compiles shaders/kernels/NAME.comp to
# SPIR-V 1.3 with these options of the compiler, and writes it as a C array to the build tree, where TARGET
# includes it as "VARIANT.spv.inc".
find_program(GEODISK_GLSLANG NAMES glslangValidator glslang REQUIRED
    DOC "The GLSL compiler (package glslang-tools)")
find_program(GEODISK_SPIRV_OPT NAMES spirv-opt DOC "The SPIR-V optimizer (package spirv-tools)")
find_program(GEODISK_SPIRV_VAL NAMES spirv-val DOC "The SPIR-V validator (package spirv-tools)")
if(NOT GEODISK_SPIRV_OPT)
    message(STATUS "geodisk: no spirv-opt, so lavapipe takes longer to compile kernels")
endif()
set(GEODISK_SPIRV_ARRAY "${CMAKE_CURRENT_LIST_DIR}/SpirvArray.cmake")

function(geodisk_add_kernel target name variant)
    geodisk_add_shader(${target} "${PROJECT_SOURCE_DIR}/shaders/kernels/${name}.comp" ${variant} ${ARGN})
endfunction()

# geodisk_add_shader(TARGET SOURCE VARIANT [OPTIMIZED] [OPTION...]): the same of any shader.
#
# OPTIMIZED is for kernels of lavapipe: it compiles them in less than half the time, which programs that
# run for a moment feel. Kernels of GPUs would take half as many registers again. What `precise` marks
# stays as it is, so results are the same.
function(geodisk_add_shader target source variant)
    cmake_parse_arguments(PARSE_ARGV 3 shader "OPTIMIZED" "" "")
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/kernels")
    set(binary "${folder}/${variant}.spv")
    set(header "${folder}/${variant}.spv.inc")
    file(MAKE_DIRECTORY "${folder}")
    set(finish "")
    if(shader_OPTIMIZED AND GEODISK_SPIRV_OPT)
        list(APPEND finish COMMAND "${GEODISK_SPIRV_OPT}" -O --target-env=vulkan1.1
            "${binary}" -o "${binary}")
    endif()
    if(GEODISK_SPIRV_VAL)
        list(APPEND finish COMMAND "${GEODISK_SPIRV_VAL}" --target-env vulkan1.1 "${binary}")
    endif()
    add_custom_command(
        OUTPUT "${binary}"
        COMMAND "${GEODISK_GLSLANG}" --quiet --target-env vulkan1.1 ${shader_UNPARSED_ARGUMENTS} -V "${source}"
            --depfile "${binary}.d" -o "${binary}"
        ${finish}
        DEPENDS "${source}"
        DEPFILE "${binary}.d"
        COMMENT "Compiling shader ${variant}"
        VERBATIM)
    add_custom_command(
        OUTPUT "${header}"
        COMMAND "${CMAKE_COMMAND}" "-DBINARY=${binary}" "-DNAME=k_${variant}_spirv"
            "-DHEADER=${header}" -P "${GEODISK_SPIRV_ARRAY}"
        DEPENDS "${binary}" "${GEODISK_SPIRV_ARRAY}"
        COMMENT "Writing shader ${variant}"
        VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${folder}")
endfunction()
