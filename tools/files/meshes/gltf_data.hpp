// The numbers of a glTF file: its buffers, the views of them and what accessors read there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "files/meshes/gltf_json.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// Promises of an accessor.
struct GltfAccessor {
    std::uint64_t count = 0;
    std::uint64_t component_type = 0;
    std::size_t components = 0; ///< In each element: 3 for VEC3.
    bool is_normalized = false;

    /// Returns the number that its integers are divided by.
    double divisor() const;
    /// Returns true for integers that stand for themselves.
    bool is_whole() const;
};

/// Reads accessors, and of the buffers only those that they need. Buffers and images are in the
/// file, in the text of the document, or in files of its scope. Throws UserError(bad_input);
/// `where` begins messages, as "mesh 0, primitive 0".
class GltfData {
  public:
    /// `binary` is the binary chunk of a .glb file; it must outlive this.
    GltfData(const GltfDocument& document, std::string_view binary, const FileScope& scope)
        : document_(document), binary_(binary), scope_(scope) {}

    GltfAccessor describe(std::uint64_t accessor, const std::string& where) const;
    /// Returns true if an accessor has numbers of its own, so that they are not all zero.
    bool has_values(std::uint64_t accessor, const std::string& where) const;

    /// Returns the numbers of an accessor, element after element. `type` is as "VEC3".
    std::vector<double> numbers(std::uint64_t accessor, std::string_view type,
                                const std::string& where);
    /// The same for single integers.
    std::vector<std::uint32_t> integers(std::uint64_t accessor, const std::string& where);

    /// Returns the bytes of the data or file that a URI names. `what` begins messages.
    std::string uri_bytes(const std::string& uri, const std::string& what);
    /// Returns the bytes of a view, decompressed if need be.
    std::string_view view_bytes(std::uint64_t view, const std::string& where);

    /// Returns warnings about the data.
    const std::vector<MeshWarning>& warnings() const noexcept { return warnings_; }

  private:
    struct Elements;

    std::string_view buffer_bytes(std::uint64_t buffer, const std::string& where);
    std::string_view range(std::uint64_t buffer, const GltfJson& object, const std::string& name,
                           const std::string& where);
    bool decompress(const GltfJson& view, std::uint64_t index, const std::string& where);
    Elements elements(std::uint64_t view, std::uint64_t offset, std::uint64_t count,
                      std::uint64_t component_type, std::size_t components,
                      const std::string& where);
    std::uint32_t integer(const Elements& all, std::uint64_t i, const std::string& where) const;
    template <class Value, class Read>
    std::vector<Value> read(std::uint64_t accessor, const GltfAccessor& about, const Read& read,
                            const std::string& where);

    const GltfDocument& document_;
    std::string_view binary_;
    const FileScope& scope_;
    std::map<std::uint64_t, std::string> loaded_;       ///< Buffers.
    std::map<std::uint64_t, std::string> decompressed_; ///< Views.
    std::vector<MeshWarning> warnings_;
};

} // namespace geodisk::tools
