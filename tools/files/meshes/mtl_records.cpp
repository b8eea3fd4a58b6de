#include "files/meshes/mtl_records.hpp"

#include <algorithm>
#include <map>

#include "files/input_file.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns `line` up to a comment. Names of files may hold a '#', but not after a blank.
std::string_view without_remark(std::string_view line) {
    for (std::size_t at = line.find('#'); at != std::string_view::npos;
         at = line.find('#', at + 1)) {
        if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') {
            return line.substr(0, at);
        }
    }
    return line;
}

/// Number of words that follow an option of a map; those of a place or size are 1 to 3.
const std::map<std::string_view, std::size_t>& option_sizes() {
    static const std::map<std::string_view, std::size_t> kSizes{
        {"-blendu", 1}, {"-blendv", 1},  {"-bm", 1},  {"-boost", 1}, {"-cc", 1},
        {"-clamp", 1},  {"-imfchan", 1}, {"-mm", 2},  {"-o", 3},     {"-s", 3},
        {"-t", 3},      {"-texres", 1},  {"-type", 1}};
    return kSizes;
}

} // namespace

std::string joined_text(Words words) {
    return words.empty()
               ? ""
               : std::string(words.front().data(), words.back().data() + words.back().size());
}

bool MtlRecords::next(std::vector<std::string_view>& words) {
    for (std::string_view line; lines_.next(line);) {
        split_tokens(without_remark(line), words);
        if (!words.empty()) {
            return true;
        }
    }
    return false;
}

std::vector<std::string> library_names(const std::string& text,
                                       const std::function<bool(const std::string&)>& is_file) {
    constexpr std::size_t kMaxWords = 64; // Of one name.
    std::vector<std::string_view> words;
    split_tokens(text, words);
    std::vector<std::string> names;
    for (Words rest(words); !rest.empty();) {
        std::size_t count = std::min(rest.size(), kMaxWords);
        while (count > 0 && !is_file(joined_text(rest.first(count)))) {
            --count;
        }
        if (count == 0) {
            const auto last = std::ranges::find_if(rest, [](std::string_view word) {
                return lower_case(std::string(word)).ends_with(".mtl");
            });
            count = last == rest.end() ? 1 : static_cast<std::size_t>(last - rest.begin()) + 1;
        }
        names.push_back(joined_text(rest.first(count)));
        rest = rest.subspan(count);
    }
    return names;
}

std::size_t map_option_size(Words words) {
    if (words.size() < 2 || !option_sizes().contains(words[0])) {
        return 0;
    }
    std::size_t size = std::min(option_sizes().at(words[0]), words.size() - 2);
    if (has_numbers(words[0])) {
        std::size_t count = 0;
        while (count < size && parse_real(words[count + 1])) {
            ++count;
        }
        size = count;
    }
    return size + 1;
}

bool has_numbers(std::string_view map_option) {
    return map_option == "-o" || map_option == "-s" || map_option == "-t";
}

} // namespace geodisk::tools
