# Compiles every kernel with AMD's compiler of Mesa, RADV, which for that needs no GPU, and holds what
# it tells of them against the bounds below. Keeps the figures in OUTPUT, as JSON.
#
# No kernel may take scratch memory or spill vector registers: lanes would then wait for memory in the
# innermost loops. Scalar registers may spill a few: they go to lanes of a single vector register. The
# bound on vector registers leaves GFX6 to GFX9 two waves per SIMD, and later ones eight.
set(max_scratch_bytes 0)
set(max_spilled_vgprs 0)
set(max_spilled_sgprs 24)
set(max_vgprs 128)

# Fails where a statistic of a kernel is missing or more.
function(require_at_most most name statistics kernel)
    string(JSON value ERROR_VARIABLE missing GET "${statistics}" "${name}")
    if(missing)
        message(FATAL_ERROR "${kernel}: the driver does not tell \"${name}\": ${statistics}")
    endif()
    if(value GREATER most)
        message(FATAL_ERROR "${kernel}: \"${name}\" is ${value}, more than ${most}")
    endif()
endfunction()

set(manifest "$ENV{GEODISK_RADV_DRIVER}")
if(NOT manifest)
    file(GLOB manifest "/usr/share/vulkan/icd.d/radeon_icd.*.json")
endif()
if(NOT EXISTS "${manifest}")
    if("$ENV{CI}" STREQUAL "true")
        message(FATAL_ERROR "the RADV driver is not installed (package mesa-vulkan-drivers)")
    endif()
    message("skipped: the RADV driver is not installed (package mesa-vulkan-drivers)")
    return()
endif()
set(ENV{VK_DRIVER_FILES} "${manifest}")
set(ENV{VK_ICD_FILENAMES} "${manifest}") # The older name of the same.
set(ENV{XDG_CACHE_HOME} "${OUTPUT}/cache") # No tuning of the user's.
file(MAKE_DIRECTORY "${OUTPUT}")

# Compiles for a GPU; its figures go to a file named so.
function(check_kernels name family min_kernels)
    set(ENV{RADV_FORCE_FAMILY} "${family}")
    execute_process(COMMAND "${GEODISK}" info --kernels --json
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE error)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${name}: geodisk info --kernels ends with ${status}: ${error}")
    endif()
    file(WRITE "${OUTPUT}/${name}.json" "${output}")
    string(JSON kernels GET "${output}" kernels)
    string(JSON count LENGTH "${kernels}")
    if(count LESS min_kernels)
        message(FATAL_ERROR "${name}: only ${count} kernels")
    endif()
    math(EXPR last "${count} - 1")
    foreach(index RANGE ${last})
        string(JSON kernel GET "${kernels}" ${index})
        string(JSON title GET "${kernel}" kernel)
        string(JSON variant GET "${kernel}" variant)
        string(JSON statistics GET "${kernel}" statistics)
        set(title "${name}: ${title} (${variant})")
        require_at_most(${max_scratch_bytes} "Scratch size" "${statistics}" "${title}")
        require_at_most(${max_spilled_vgprs} "Spilled VGPRs" "${statistics}" "${title}")
        require_at_most(${max_spilled_sgprs} "Spilled SGPRs" "${statistics}" "${title}")
        require_at_most(${max_vgprs} "VGPRs" "${statistics}" "${title}")
    endforeach()
    message("${name}: ${count} kernels")
endfunction()

# GFX9 and GFX10.3. Kernels with texel buffers are for lavapipe.
check_kernels(vega10 vega10 86)
check_kernels(navi21 navi21 86)
message("figures are in ${OUTPUT}")
