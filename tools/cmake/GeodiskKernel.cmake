# geodisk_add_kernel(TARGET NAME VARIANT [OPTION...]): compiles shaders/kernels/NAME.comp to SPIR-V 1.3
# with these options of the compiler, and writes it as a C array to the build tree, where TARGET includes
# it as "VARIANT.spv.inc".
find_program(GEODISK_GLSLANG NAMES glslangValidator glslang REQUIRED
    DOC "The GLSL compiler (package glslang-tools)")
find_program(GEODISK_SPIRV_VAL NAMES spirv-val DOC "The SPIR-V validator (package spirv-tools)")

function(geodisk_add_kernel target name variant)
    geodisk_add_shader(${target} "${PROJECT_SOURCE_DIR}/shaders/kernels/${name}.comp" ${variant} ${ARGN})
endfunction()

# geodisk_add_shader(TARGET SOURCE VARIANT [OPTION...]): the same of any shader.
function(geodisk_add_shader target source variant)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/kernels")
    set(binary "${folder}/${variant}.spv")
    set(header "${folder}/${variant}.spv.inc")
    file(MAKE_DIRECTORY "${folder}")
    set(compile "${GEODISK_GLSLANG}" --quiet --target-env vulkan1.1 ${ARGN} -V "${source}")
    set(validate "")
    if(GEODISK_SPIRV_VAL)
        set(validate COMMAND "${GEODISK_SPIRV_VAL}" --target-env vulkan1.1 "${binary}")
    endif()
    add_custom_command(
        OUTPUT "${header}"
        COMMAND ${compile} -o "${binary}"
        ${validate}
        COMMAND ${compile} --vn "k_${variant}_spirv" --depfile "${header}.d" -o "${header}"
        DEPENDS "${source}"
        DEPFILE "${header}.d"
        COMMENT "Compiling shader ${variant}"
        VERBATIM)
    target_sources(${target} PRIVATE "${header}")
    target_include_directories(${target} PRIVATE "${folder}")
endfunction()
