#include "files/samples/gifti_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "files/base64.hpp"
#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/name_text.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns text inside XML. Control characters, which XML does not hold, become blanks.
std::string xml_text(std::string_view text) {
    std::string result;
    for (const char c : readable_name(text)) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    }
    return result;
}

std::string meta_data(const GiftiEntries& entries) {
    std::string text = "<MetaData>\n";
    for (const auto& [name, value] : entries) {
        text +=
            "<MD><Name>" + xml_text(name) + "</Name><Value>" + xml_text(value) + "</Value></MD>\n";
    }
    return text + "</MetaData>\n";
}

void begin_gifti(AtomicFile& file, std::size_t arrays, const GiftiEntries& entries) {
    file.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
               "<!DOCTYPE GIFTI SYSTEM \"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n"
               "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"" +
               std::to_string(arrays) + "\">\n" + meta_data(entries));
}

void end_gifti(AtomicFile& file) {
    file.write("</GIFTI>\n");
}

/// Writes numbers of four bytes; `value(i)` is number i.
template <class Value>
void write_array(AtomicFile& file, const std::string& intent, const std::string& type,
                 const std::string& name, std::size_t count, const Value& value) {
    constexpr std::size_t kAtOnce = 3 << 16; // Bytes of three numbers end with a digit of base64.
    file.write("<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
               "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"1\" Dim0=\"" +
               std::to_string(count) +
               "\" Encoding=\"Base64Binary\" Endian=\"LittleEndian\" ExternalFileName=\"\" "
               "ExternalFileOffset=\"\">\n" +
               meta_data({{"Name", name}}) + "<Data>");
    for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
        std::string bytes, text;
        for (std::size_t i = begin; i < std::min(begin + kAtOnce, count); ++i) {
            append_little_endian(bytes, value(i));
        }
        append_base64(text, bytes);
        file.write(text);
    }
    file.write("</Data>\n</DataArray>\n");
}

} // namespace

bool is_gifti(const Path& path) {
    return lower_extension(path) == ".gii";
}

void write_gifti_distances(AtomicFile& file, const DistanceTable& table,
                           const GiftiEntries& entries) {
    const bool has_rows = table.nearest.empty();
    const std::size_t rows = has_rows ? table.sources.size() : 1;
    const std::size_t vertices = table.distances.size() / rows;
    begin_gifti(file, rows, entries);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::string name = has_rows || table.sources.size() == 1
                                     ? "distance from " + std::to_string(table.sources[row])
                                     : "distance from the nearest source";
        write_array(file, "SHAPE", "FLOAT32", name, vertices, [&](std::size_t i) {
            const double distance = table.distances[row * vertices + i];
            return std::isfinite(distance) ? static_cast<float>(distance)
                                           : std::numeric_limits<float>::quiet_NaN();
        });
    }
    end_gifti(file);
}

void write_gifti_labels(AtomicFile& file, std::span<const std::int32_t> keys,
                        std::span<const GiftiLabel> labels, const GiftiEntries& entries) {
    begin_gifti(file, 1, entries);
    std::string table = "<LabelTable>\n";
    for (const GiftiLabel& label : labels) {
        table += "<Label Key=\"" + std::to_string(label.key) + '"';
        for (std::size_t i = 0; i < label.colour.size(); ++i) {
            constexpr const char* kNames[] = {"Red", "Green", "Blue", "Alpha"};
            table += std::string(" ") + kNames[i] + "=\"" + exact_text(label.colour[i]) + '"';
        }
        table += '>' + xml_text(label.name) + "</Label>\n";
    }
    file.write(table + "</LabelTable>\n");
    write_array(file, "LABEL", "INT32", "cells", keys.size(),
                [&](std::size_t i) { return keys[i]; });
    end_gifti(file);
}

} // namespace geodisk::tools
