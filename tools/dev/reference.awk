# Turns the comments of the headers into those that Doxygen reads: the one that a header begins with is
# about the file, and those of geodisk.h are C's, of what follows or, behind code, of what stands before.
FNR == 1 { begins = FILENAME ~ /\.hpp$/ }
begins && /^\/\// {
    sub(/^\/\/ ?/, FNR == 1 ? "/// @file\n/// " : "/// ")
    print
    next
}
{ begins = 0 }
FILENAME ~ /\.h$/ {
    if (FNR == 1)
        sub(/^\/\*/, "/** @file\n *")
    else if (/^\/\* ----/)
        $0 = "" # A heading.
    else if (/^ *\/\*/)
        sub(/\/\*/, "/**")
    else
        sub(/\/\*/, "/**<")
}
{ print }
