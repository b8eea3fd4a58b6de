// In place of the readers of XML, where geodisk is built without pugixml.
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/value_files.hpp"
#include "files/samples/sample_rows.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

[[noreturn]] void fail_without_xml(const Path& path) {
    fail_input(path, "is XML, which this build of geodisk does not read (no pugixml); convert it");
}

} // namespace

PolygonMesh read_vtp(const Path& path, const WantedFields& /*fields*/) {
    fail_without_xml(path);
}

PolygonMesh read_gifti(const Path& path, const WantedFields& /*fields*/) {
    fail_without_xml(path);
}

SampleFile read_vtp_samples(const Path& path, std::string&& /*bytes*/, SampleDomain /*domain*/,
                            const std::string& /*numbers*/) {
    fail_without_xml(path);
}

VertexValues read_gifti_values(const Path& path) {
    fail_without_xml(path);
}

} // namespace geodisk::tools
