# Translates every kernel to Metal's and to DirectX's language, as drivers on top of those do, and looks
# for what they refuse or would get wrong.
if(NOT SPIRV_CROSS)
    if("$ENV{CI}" STREQUAL "true")
        message(FATAL_ERROR "spirv-cross is not installed")
    endif()
    message("skipped: spirv-cross is not installed")
    return()
endif()

# Runs spirv-cross with the arguments and puts what it writes into `text`.
function(translate text kernel)
    execute_process(COMMAND "${SPIRV_CROSS}" ${ARGN} "${kernel}"
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE error)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "spirv-cross ${ARGN} ${kernel}: ${error}")
    endif()
    set(${text} "${output}" PARENT_SCOPE)
endfunction()

file(GLOB kernels "${KERNELS}/*.spv")
list(LENGTH kernels count)
if(count LESS 50)
    message(FATAL_ERROR "only ${count} kernels in ${KERNELS}")
endif()
foreach(kernel IN LISTS kernels)
    translate(metal "${kernel}" --msl --msl-version 20100)
    # Metal refuses arrays in shared memory whose size a specialization constant tells.
    if(metal MATCHES "threadgroup [a-z0-9]+ [A-Za-z_0-9]+\\[[^0-9]")
        message(FATAL_ERROR "${kernel}: \"${CMAKE_MATCH_0}\" is sized by a specialization constant")
    endif()
    translate(directx "${kernel}" --hlsl --shader-model 60)
    # Float operations that must stay separate do.
    if(kernel MATCHES "/(group_)?detect(_texels)?\\.spv$" AND
       NOT (metal MATCHES "optnone" AND directx MATCHES "precise float"))
        message(FATAL_ERROR "${kernel}: precise is lost")
    endif()
endforeach()
message("${count} kernels translated")
