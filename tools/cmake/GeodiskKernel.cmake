# geodisk_add_kernel(TARGET NAME): compiles shaders/kernels/NAME.comp to SPIR-V 1.3 and writes it as
# a C array to the build tree, where TARGET includes it as "NAME.spv.inc".
find_program(GEODISK_GLSLANG NAMES glslangValidator glslang REQUIRED
    DOC "The GLSL compiler (package glslang-tools)")
find_program(GEODISK_SPIRV_VAL NAMES spirv-val DOC "The SPIR-V validator (package spirv-tools)")

function(geodisk_add_kernel target name)
    set(source "${PROJECT_SOURCE_DIR}/shaders/kernels/${name}.comp")
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/kernels")
    set(binary "${folder}/${name}.spv")
    set(header "${folder}/${name}.spv.inc")
    file(MAKE_DIRECTORY "${folder}")
    set(validate "")
    if(GEODISK_SPIRV_VAL)
        set(validate COMMAND "${GEODISK_SPIRV_VAL}" --target-env vulkan1.1 "${binary}")
    endif()
    add_custom_command(
        OUTPUT "${header}"
        COMMAND "${GEODISK_GLSLANG}" --quiet --target-env vulkan1.1 -V "${source}" -o "${binary}"
        ${validate}
        COMMAND "${GEODISK_GLSLANG}" --quiet --target-env vulkan1.1 -V "${source}"
            --vn "k_${name}_spirv" --depfile "${header}.d" -o "${header}"
        DEPENDS "${source}"
        DEPFILE "${header}.d"
        COMMENT "Compiling kernel ${name}"
        VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${folder}")
endfunction()
