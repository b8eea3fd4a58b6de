// In place of composed names, where geodisk is built without utf8proc.
#include "files/input_file.hpp"
#include "files/name_text.hpp"

namespace geodisk::tools {

std::string composed_name(std::string_view bytes) {
    return readable_name(bytes);
}

std::string folded_name(std::string_view bytes) {
    return lower_case(readable_name(bytes));
}

} // namespace geodisk::tools
