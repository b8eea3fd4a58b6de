# geodisk_add_texts(TARGET HEADER [NAME FILE]...): writes text files as C++ to the build tree, where
# TARGET includes HEADER, in a namespace of its own and within std::literals. It has
#     struct NamedText { std::string_view name; std::span<const std::string_view> text; };
#     constexpr NamedText kTexts[]
#
# The same file, run as a script, is what writes them.
if(NOT CMAKE_SCRIPT_MODE_FILE)
    set(GEODISK_TEXTS_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

    function(geodisk_add_texts target header)
        set(folder "${CMAKE_CURRENT_BINARY_DIR}/texts")
        set(files "")
        set(pairs ${ARGN})
        while(pairs)
            list(POP_FRONT pairs name file)
            list(APPEND files "${file}")
        endwhile()
        list(JOIN ARGN "|" texts)
        add_custom_command(
            OUTPUT "${folder}/${header}"
            COMMAND "${CMAKE_COMMAND}" "-DTEXTS=${texts}" "-DHEADER=${folder}/${header}"
                -P "${GEODISK_TEXTS_SCRIPT}"
            DEPENDS ${files} "${GEODISK_TEXTS_SCRIPT}"
            COMMENT "Writing ${header}"
            VERBATIM)
        target_sources(${target} PRIVATE "${folder}/${header}")
        target_include_directories(${target} PRIVATE "${folder}")
    endfunction()
    return()
endif()

# No compiler need take longer literals.
set(most 12000)
set(delimiter "geodisk")

string(REPLACE "|" ";" texts "${TEXTS}")
set(code "// Generated.\nstruct NamedText {\n    std::string_view name;\n    std::span<const std::string_view> text;\n};\n")
set(table "")
set(number 0)
while(texts)
    list(POP_FRONT texts name file)
    file(READ "${file}" text)
    string(FIND "${text}" ")${delimiter}\"" end)
    if(NOT end EQUAL -1)
        message(FATAL_ERROR "${file} contains )${delimiter}\", which ends a literal")
    endif()
    string(LENGTH "${text}" rest)
    set(at 0)
    string(APPEND code "constexpr std::string_view kText${number}[] = {\n")
    while(rest GREATER 0)
        string(SUBSTRING "${text}" ${at} ${most} piece)
        string(APPEND code "R\"${delimiter}(${piece})${delimiter}\"sv,\n")
        math(EXPR at "${at} + ${most}")
        math(EXPR rest "${rest} - ${most}")
    endwhile()
    string(APPEND code "};\n")
    string(APPEND table "    {\"${name}\", kText${number}},\n")
    math(EXPR number "${number} + 1")
endwhile()
file(WRITE "${HEADER}" "${code}constexpr NamedText kTexts[] = {\n${table}};\n")
