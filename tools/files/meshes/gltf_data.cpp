#include "files/meshes/gltf_data.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>

#include "files/input_file.hpp"
#include "files/meshes/data_uri.hpp"
#include "files/meshes/meshopt.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

// Types of components.
constexpr std::uint64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                        kUnsignedInt = 5125, kFloat = 5126;

std::size_t size_of(std::uint64_t component_type) {
    switch (component_type) {
    case kByte:
    case kUnsignedByte:
        return 1;
    case kShort:
    case kUnsignedShort:
        return 2;
    case kUnsignedInt:
    case kFloat:
        return 4;
    default:
        return 0;
    }
}

std::size_t components_of(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kTypes{{{"SCALAR", 1},
                                                                              {"VEC2", 2},
                                                                              {"VEC3", 3},
                                                                              {"VEC4", 4},
                                                                              {"MAT2", 4},
                                                                              {"MAT3", 9},
                                                                              {"MAT4", 16}}};
    const auto found = std::ranges::find(kTypes, type, [](const auto& one) { return one.first; });
    return found == kTypes.end() ? 0 : found->second;
}

const GltfJson* meshopt_of(const GltfDocument& document, const GltfJson& view,
                           const std::string& name) {
    const GltfJson* const found = document.find_extension(view, "EXT_meshopt_compression", name);
    return found != nullptr ? found
                            : document.find_extension(view, "KHR_meshopt_compression", name);
}

} // namespace

bool GltfAccessor::is_whole() const {
    return component_type != kFloat && !is_normalized;
}

double GltfAccessor::divisor() const {
    const auto largest = [](auto value) {
        return static_cast<double>(std::numeric_limits<decltype(value)>::max());
    };
    switch (is_normalized ? component_type : kFloat) {
    case kByte:
        return largest(std::int8_t{});
    case kUnsignedByte:
        return largest(std::uint8_t{});
    case kShort:
        return largest(std::int16_t{});
    case kUnsignedShort:
        return largest(std::uint16_t{});
    case kUnsignedInt:
        return largest(std::uint32_t{});
    default:
        return 1;
    }
}

/// Elements of a view, all within it.
struct GltfData::Elements {
    const char* first = nullptr;
    std::uint64_t stride = 0;
    std::uint64_t type = 0; ///< Type of a component.

    template <class Value>
    Value value(std::uint64_t element, std::size_t component) const {
        Value result;
        std::memcpy(&result, first + element * stride + component * sizeof result, sizeof result);
        return result; // Hosts of geodisk are little-endian, as glTF is.
    }
};

std::string GltfData::uri_bytes(const std::string& uri, const std::string& what) {
    if (uri.starts_with("data:")) {
        std::optional<std::string> bytes = data_of_uri(uri);
        if (!bytes) {
            document_.fail(what + ": its data: URI is damaged");
        }
        return std::move(*bytes);
    }
    const std::array<std::string, 2> names = uri_file_names(uri);
    for (const std::string& name : names) {
        const FoundFile found = scope_.find(document_.path(), name);
        if (!found.refusal.empty()) {
            document_.fail(what + ": " + found.refusal);
        }
        if (!found.file.empty()) {
            note_name(what, found, warnings_);
            return read_regular_file(found.file);
        }
    }
    document_.fail(what + ": " + named_path(document_.path(), names[0]).string() +
                   ": no such file");
}

/// Empty for a buffer without data, which only compressed views may name.
std::string_view GltfData::buffer_bytes(std::uint64_t buffer, const std::string& where) {
    const GltfJson& object = document_.at("buffers", "buffer", buffer);
    const std::string name = where + ", buffer " + std::to_string(buffer);
    if (!object.contains("uri")) {
        return buffer == 0 ? binary_ : std::string_view();
    }
    const auto [loaded, is_new] = loaded_.try_emplace(buffer);
    if (is_new) {
        loaded->second = uri_bytes(document_.text(object, "uri", name), name);
    }
    return loaded->second;
}

/// The part of a buffer that byteOffset and byteLength of `object` tell.
std::string_view GltfData::range(std::uint64_t buffer, const GltfJson& object,
                                 const std::string& name, const std::string& where) {
    const std::string_view bytes = buffer_bytes(buffer, where);
    const std::uint64_t offset = document_.index_or(object, "byteOffset", 0, name);
    const std::uint64_t length = document_.index(object, "byteLength", name);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        document_.fail(where + ": its data reach beyond their buffer");
    }
    return bytes.substr(offset, length);
}

/// False if the view has data of its own that are to be read instead.
bool GltfData::decompress(const GltfJson& view, std::uint64_t index, const std::string& where) {
    const std::string name = "bufferView " + std::to_string(index);
    const GltfJson* const compressed = meshopt_of(document_, view, name);
    if (compressed == nullptr) {
        return false;
    }
    MeshoptStream stream;
    stream.bytes = range(document_.index(*compressed, "buffer", name), *compressed, name, where);
    stream.count = document_.index(*compressed, "count", name);
    stream.stride = document_.index(*compressed, "byteStride", name);
    stream.mode = document_.text(*compressed, "mode", name);
    stream.filter = document_.text(*compressed, "filter", name);
    std::optional<std::string> bytes = meshopt_decoded(stream);
    if (bytes) {
        decompressed_[index] = std::move(*bytes);
        return true;
    }
    // A view may bear the same data as they are, for readers that know no compression.
    if (buffer_bytes(document_.index(view, "buffer", name), where).empty()) {
        document_.fail(where + ": " + name + " is compressed by meshoptimizer, " +
                       meshopt_failure() + "; write it without");
    }
    add_warning(warnings_, "undecoded_view", 1, name,
                "view whose compressed data cannot be decoded, read from its uncompressed data",
                "");
    return false;
}

std::string_view GltfData::view_bytes(std::uint64_t index, const std::string& where) {
    if (const auto known = decompressed_.find(index); known != decompressed_.end()) {
        return known->second;
    }
    const GltfJson& view = document_.at("bufferViews", "bufferView", index);
    if (decompress(view, index, where)) {
        return decompressed_[index];
    }
    const std::string name = "bufferView " + std::to_string(index);
    return range(document_.index(view, "buffer", name), view, name, where);
}

GltfData::Elements GltfData::elements(std::uint64_t view, std::uint64_t offset, std::uint64_t count,
                                      std::uint64_t component_type, std::size_t components,
                                      const std::string& where) {
    const std::string_view bytes = view_bytes(view, where);
    const GltfJson& object = document_.at("bufferViews", "bufferView", view);
    const std::string name = "bufferView " + std::to_string(view);
    const std::uint64_t element = size_of(component_type) * components;
    std::uint64_t stride = document_.index_or(object, "byteStride", 0, name);
    if (stride == 0 && decompressed_.contains(view)) {
        stride = document_.index(*meshopt_of(document_, object, name), "byteStride", name);
    }
    stride = stride == 0 ? element : stride;
    // In an order in which no sum or product can overflow.
    const bool fits = offset <= bytes.size() && stride >= element &&
                      (count == 0 || (element <= bytes.size() - offset &&
                                      count - 1 <= (bytes.size() - offset - element) / stride));
    if (!fits) {
        document_.fail(where + ": its data reach beyond their buffer");
    }
    return {bytes.data() + offset, stride, component_type};
}

GltfAccessor GltfData::describe(std::uint64_t accessor, const std::string& where) const {
    const GltfJson& object = document_.at("accessors", "accessor", accessor);
    const std::string name = where + ", accessor " + std::to_string(accessor);
    GltfAccessor about;
    about.count = document_.index(object, "count", name);
    about.component_type = document_.index(object, "componentType", name);
    about.components = components_of(document_.text(object, "type", name));
    about.is_normalized = document_.flag(object, "normalized", name);
    if (size_of(about.component_type) == 0) {
        document_.fail(where + ": component type " + std::to_string(about.component_type) +
                       " is unknown");
    }
    if (about.components == 0) {
        document_.fail(name + ": its type is unknown");
    }
    return about;
}

bool GltfData::has_values(std::uint64_t accessor, const std::string& where) const {
    const GltfJson& object = document_.at("accessors", "accessor", accessor);
    return document_.find_index(object, "bufferView", where) ||
           document_.find_object(object, "sparse", where) != nullptr;
}

/// `read(elements, i, k)` is component k of element i.
template <class Value, class Read>
std::vector<Value> GltfData::read(std::uint64_t accessor, const GltfAccessor& about,
                                  const Read& read, const std::string& where) {
    const GltfJson& object = document_.at("accessors", "accessor", accessor);
    const std::optional<std::uint64_t> view = document_.find_index(object, "bufferView", where);
    // Without a view all are zero but those replaced; a short file could ask for any number.
    constexpr std::uint64_t kMaxZeros = std::uint64_t{1} << 20;
    if (!view && about.count > kMaxZeros) {
        document_.fail(where + ": its data are missing");
    }
    std::vector<Value> values;
    const auto append = [&](const Elements& all, std::uint64_t i) {
        for (std::size_t k = 0; k < about.components; ++k) {
            values.push_back(read(all, i, k));
        }
    };
    if (view) {
        const Elements all = elements(*view, document_.index_or(object, "byteOffset", 0, where),
                                      about.count, about.component_type, about.components, where);
        values.reserve(about.count * about.components);
        for (std::uint64_t i = 0; i < about.count; ++i) {
            append(all, i);
        }
    } else {
        values.resize(about.count * about.components);
    }
    const GltfJson* const sparse = document_.find_object(object, "sparse", where);
    if (sparse == nullptr) {
        return values;
    }
    const std::string name = where + ", sparse accessor";
    const std::uint64_t replaced = document_.index(*sparse, "count", name);
    const GltfJson* const places = document_.find_object(*sparse, "indices", name);
    const GltfJson* const news = document_.find_object(*sparse, "values", name);
    if (places == nullptr || news == nullptr) {
        document_.fail(name + ": has no indices or values");
    }
    const Elements indices = elements(document_.index(*places, "bufferView", name),
                                      document_.index_or(*places, "byteOffset", 0, name), replaced,
                                      document_.index(*places, "componentType", name), 1, where);
    const Elements others = elements(document_.index(*news, "bufferView", name),
                                     document_.index_or(*news, "byteOffset", 0, name), replaced,
                                     about.component_type, about.components, where);
    for (std::uint64_t i = 0; i < replaced; ++i) {
        const std::uint64_t index = integer(indices, i, name);
        if (index >= about.count) {
            document_.fail(where + ": sparse index " + std::to_string(index) + " is out of range");
        }
        for (std::size_t k = 0; k < about.components; ++k) {
            values[index * about.components + k] = read(others, i, k);
        }
    }
    return values;
}

std::uint32_t GltfData::integer(const Elements& all, std::uint64_t i,
                                const std::string& where) const {
    switch (all.type) {
    case kUnsignedByte:
        return all.value<std::uint8_t>(i, 0);
    case kUnsignedShort:
        return all.value<std::uint16_t>(i, 0);
    case kUnsignedInt:
        return all.value<std::uint32_t>(i, 0);
    default:
        document_.fail(where + ": indices of component type " + std::to_string(all.type));
    }
}

std::vector<double> GltfData::numbers(std::uint64_t accessor, std::string_view type,
                                      const std::string& where) {
    const GltfAccessor about = describe(accessor, where);
    if (about.components != components_of(type)) {
        document_.fail(where + ": accessor " + std::to_string(accessor) + " is not of type " +
                       std::string(type));
    }
    const double divisor = about.divisor();
    const auto number = [&](const Elements& all, std::uint64_t i, std::size_t k) -> double {
        const auto scaled = [&](auto value) {
            const auto exact = static_cast<double>(value);
            return about.is_normalized ? std::max(exact / divisor, -1.0) : exact;
        };
        switch (all.type) {
        case kFloat:
            return static_cast<double>(all.value<float>(i, k));
        case kByte:
            return scaled(all.value<std::int8_t>(i, k));
        case kUnsignedByte:
            return scaled(all.value<std::uint8_t>(i, k));
        case kShort:
            return scaled(all.value<std::int16_t>(i, k));
        case kUnsignedShort:
            return scaled(all.value<std::uint16_t>(i, k));
        default:
            return scaled(all.value<std::uint32_t>(i, k));
        }
    };
    return read<double>(accessor, about, number, where);
}

std::vector<std::uint32_t> GltfData::integers(std::uint64_t accessor, const std::string& where) {
    const GltfAccessor about = describe(accessor, where);
    if (about.components != 1) {
        document_.fail(where + ": its indices are no single numbers");
    }
    return read<std::uint32_t>(
        accessor, about,
        [&](const Elements& all, std::uint64_t i, std::size_t) { return integer(all, i, where); },
        where);
}

} // namespace geodisk::tools
