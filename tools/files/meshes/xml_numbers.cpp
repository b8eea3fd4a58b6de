#include "files/meshes/xml_numbers.hpp"

#include <limits>

#include "files/text_tokens.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

std::vector<double> numbers_of_text(const XmlFile& file, const pugi::xml_node& node,
                                    std::string_view text, std::uint64_t count) {
    std::vector<double> numbers;
    if (count <= (text.size() + 1) / 2) { // Otherwise there are fewer in any case.
        numbers.reserve(count);
    }
    TextTokens words(text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const std::optional<double> value = parse_real(word);
        if (!value) {
            file.fail(node, "has " + in_quotes(word) + ", which is not a number");
        }
        numbers.push_back(*value);
    }
    if (numbers.size() != count) {
        file.fail(node, "has " + counted(numbers.size(), "number", "numbers") + ", not " +
                            grouped(count));
    }
    return numbers;
}

std::vector<double> numbers_of_bytes(std::string_view bytes, const NumberType& type,
                                     bool is_little) {
    std::vector<double> numbers(bytes.size() / type.size);
    const char* at = bytes.data();
    for (double& number : numbers) {
        number = type.value(at, is_little);
        at += type.size;
    }
    return numbers;
}

std::size_t bytes_of_numbers(const XmlFile& file, const pugi::xml_node& node,
                             const NumberType& type, std::uint64_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(double)) {
        file.fail(node, "should have " + grouped(count) + " numbers, more than any memory has");
    }
    return static_cast<std::size_t>(count) * type.size;
}

} // namespace geodisk::tools
