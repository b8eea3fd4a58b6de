#include "report/page.hpp"

#include <stdexcept>

#include "files/output/output_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "report/front_end.hpp"

namespace geodisk::tools::report {
namespace {

void write_text(AtomicFile& file, Text text) {
    for (const std::string_view piece : text) {
        file.write(piece);
    }
}

void write_array(AtomicFile& file, const PageArray& array) {
    std::string head = "<script type=\"text/plain\" id=\"" + array.name + "\" data-type=\"";
    head.append(array.type).append("\" data-count=\"").append(exact_text(array.count));
    head.append("\" data-low=\"").append(exact_text(array.low));
    head.append("\" data-high=\"").append(exact_text(array.high)).append("\">");
    file.write(head);
    file.write(base64_of(array.bytes));
    file.write("</script>\n");
}

void write_part(AtomicFile& file, const Page& page, std::string_view name) {
    if (name == "facts") {
        file.write(in_script(page.facts));
    } else if (name == "arrays") {
        for (const PageArray& array : page.arrays) {
            check_interrupted();
            write_array(file, array);
        }
    } else if (const Text text = front_end_text(name); !text.empty()) {
        write_text(file, text);
    } else {
        throw std::logic_error("page.html names a text that there is none of: " +
                               std::string(name));
    }
}

} // namespace

std::string in_script(std::string json) {
    // Within JSON it is in strings alone, and nothing else ends a script or begins a comment.
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
        json.replace(at, 1, "\\u003c");
    }
    return json;
}

void require_front_end() {
    if (!has_front_end()) {
        throw UserError(ExitCode::usage,
                        "this geodisk was built without three.js, which pages need");
    }
}

void write_page(AtomicFile& file, const Page& page) {
    std::string frame;
    for (const std::string_view piece : front_end_text("page.html")) {
        frame += piece;
    }
    std::string_view rest = frame;
    for (std::size_t mark; (mark = rest.find("{{")) != std::string_view::npos;) {
        const std::size_t end = rest.find("}}", mark);
        file.write(rest.substr(0, mark));
        write_part(file, page, rest.substr(mark + 2, end - mark - 2));
        rest.remove_prefix(end + 2);
    }
    file.write(rest);
}

} // namespace geodisk::tools::report
