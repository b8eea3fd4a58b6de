# Writes a SPIR-V binary as an array of words in C: cmake -DBINARY=FILE -DNAME=ARRAY -DHEADER=FILE -P
# SpirvArray.cmake
file(READ "${BINARY}" bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
# Lines of eight words, as editors and debuggers like them short.
string(REGEX REPLACE "(...........)(...........)(...........)(...........)(...........)(...........)(...........)(...........)"
    "\\1\\2\\3\\4\\5\\6\\7\\8\n" words "${words}")
file(WRITE "${HEADER}" "#pragma once\nconst uint32_t ${NAME}[] = {\n${words}\n};\n")
