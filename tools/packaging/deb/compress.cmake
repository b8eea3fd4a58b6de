# Compresses, in the files that CPack is about to pack, what Debian has compressed.
file(GLOB_RECURSE texts "${CPACK_TEMPORARY_DIRECTORY}/geodisk*.1"
    "${CPACK_TEMPORARY_DIRECTORY}/changelog.Debian")
if(NOT texts)
    message(FATAL_ERROR "geodisk: no manual pages and no changelog in ${CPACK_TEMPORARY_DIRECTORY}")
endif()
execute_process(COMMAND gzip --best --no-name ${texts} COMMAND_ERROR_IS_FATAL ANY)
