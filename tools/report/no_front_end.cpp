// In place of the front end, where geodisk is built without three.js.
#include "report/front_end.hpp"

namespace geodisk::tools::report {

bool has_front_end() {
    return false;
}

Text front_end_text(std::string_view /*name*/) {
    return {};
}

} // namespace geodisk::tools::report
