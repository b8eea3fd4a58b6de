#include "geodisk/reports/map_report.hpp"

#include <sstream>

#include <geodisk/version.hpp>

#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/run_report.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
std::string MapReport::json(double write_seconds) const {
    Json document{{"version", GEODISK_VERSION_STRING},
                  {"mesh", mesh_json(mesh)},
                  {"warnings", warnings_json(warnings)},
                  {"samples", samples},
                  {"size", {result.map.width, result.map.height}},
                  {"texels",
                   {{"covered", result.covered},
                    {"overlapping", result.overlapping},
                    {"padded", result.padded},
                    {"unreached", result.unreached}}},
                  {"repeating_faces", result.repeating},
                  {"largest_distance", result.largest_distance},
                  {"error", result.error},
                  {"disks", result.done.run.disks},
                  {"windows", result.done.run.windows},
                  {"output", output}};
    return search_json(std::move(document), mesh, result.done, write_seconds);
}

std::string MapReport::summary(double write_seconds) const {
    std::ostringstream out;
    out << mesh_lines("mesh", mesh) << "texels        " << grouped(result.covered) << " of "
        << grouped(result.map.width) << " x " << grouped(result.map.height) << " have a face\n"
        << "samples       " << grouped(samples) << ", at most "
        << rounded(result.largest_distance, 6) << " away, exact to " << rounded(result.error, 2)
        << '\n';
    if (result.padded > 0) {
        out << "padding       " << counted(result.padded, "texel", "texels") << " around these\n";
    }
    if (result.overlapping > 0) {
        out << "overlaps      " << counted(result.overlapping, "texel has", "texels have")
            << " several faces; the lowest counts\n";
    }
    if (result.repeating > 0) {
        out << "repeats       " << counted(result.repeating, "face has", "faces have")
            << " texture coordinates outside of 0 to 1, which wrap around\n";
    }
    if (result.unreached > 0) {
        out << "no sample     in the parts of the mesh of "
            << counted(result.unreached, "texel", "texels") << '\n';
    }
    out << search_text(mesh, result.done, write_seconds, output, "finding samples");
    return out.str();
}

} // namespace geodisk::tools
