# Fails unless LIBRARY, as NM and READELF tell, shows the functions of SYMBOLS and nothing else,
# and has SONAME.
execute_process(COMMAND "${NM}" -D --defined-only "${LIBRARY}"
    OUTPUT_VARIABLE told COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " [TDBRVWi] [^\n@]+" found "${told}")
list(TRANSFORM found REPLACE "^ . " "")
list(SORT found)
file(STRINGS "${SYMBOLS}" expected)
list(SORT expected)
if(NOT found STREQUAL expected)
    set(added ${found})
    set(lost ${expected})
    list(REMOVE_ITEM added ${expected})
    list(REMOVE_ITEM lost ${found})
    message(FATAL_ERROR "${LIBRARY} shows in addition: ${added}; and no longer: ${lost}")
endif()
execute_process(COMMAND "${READELF}" -d "${LIBRARY}"
    OUTPUT_VARIABLE told COMMAND_ERROR_IS_FATAL ANY)
if(NOT told MATCHES "SONAME[^\n]*\\[${SONAME}\\]")
    message(FATAL_ERROR "${LIBRARY} is not ${SONAME}: ${told}")
endif()
