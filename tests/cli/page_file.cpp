#include "cli/page_file.hpp"

#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "support/base64.hpp"
#include "support/typed_array.hpp"
#include "unit/test_files.hpp"

namespace geodisk::test {
namespace {

/// Returns what stands between the next `begin` from `at` on and the `end` after it; `at` is then
/// behind it.
std::optional<std::string_view> between(std::string_view text, std::size_t& at,
                                        std::string_view begin, std::string_view end) {
    const std::size_t from = text.find(begin, at);
    const std::size_t to = text.find(end, from + begin.size());
    if (from == std::string_view::npos || to == std::string_view::npos) {
        return std::nullopt;
    }
    at = to + end.size();
    return text.substr(from + begin.size(), to - from - begin.size());
}

std::string attribute(std::string_view tag, const std::string& name) {
    std::size_t at = 0;
    const auto value = between(tag, at, name + "=\"", "\"");
    if (!value) {
        throw std::runtime_error("an array has no " + name);
    }
    return std::string(*value);
}

std::vector<double> numbers_of(std::string_view tag, std::string_view base64) {
    return typed_numbers(attribute(tag, "data-type"), bytes_of_base64(base64),
                         std::stoull(attribute(tag, "data-count")),
                         std::stod(attribute(tag, "data-low")),
                         std::stod(attribute(tag, "data-high")));
}

} // namespace

PageFile read_page(const std::filesystem::path& path) {
    std::string text = tools::bytes_of(path);
    std::size_t at = 0;
    const auto facts =
        between(text, at, "<script type=\"application/json\" id=\"facts\">", "</script>");
    if (!facts) {
        throw std::runtime_error("the page has no facts");
    }
    nlohmann::ordered_json parsed = nlohmann::ordered_json::parse(*facts);
    std::map<std::string, std::vector<double>> arrays;
    while (const auto tag = between(text, at, "<script type=\"text/plain\" id=", ">")) {
        const auto content = between(text, at, "", "</script>");
        if (content && tag->find("data-type") != std::string_view::npos) {
            arrays[attribute("id=" + std::string(*tag), "id")] = numbers_of(*tag, *content);
        }
    }
    return {std::move(text), std::move(parsed), std::move(arrays)};
}

} // namespace geodisk::test
