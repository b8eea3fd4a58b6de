#include "bench/report.hpp"

#include <type_traits>

#include <nlohmann/json.hpp>

#include "bench/fields.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"

namespace geodisk::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class Record>
void add_fields(Json& object, const Record& record) {
    visit_fields(record, [&](const char* name, const auto& value) { object[name] = value; });
}

template <class Value>
std::string value_text(const Value& value) {
    if constexpr (std::is_same_v<Value, std::string>) {
        return tools::one_line(value);
    } else if constexpr (std::is_same_v<Value, bool>) {
        return value ? "true" : "false";
    } else {
        return tools::exact_text(value);
    }
}

Json growth_json(const Series& series, const Growth& growth) {
    Json entry{{"sweep", to_string(series.sweep)},
               {"mesh", series.mesh},
               {"quantity", std::string(growth.quantity) + "_seconds"}};
    if (growth.law) {
        entry["exponent"] = growth.law->exponent;
        entry["factor"] = growth.law->factor;
        entry["r_squared"] = growth.law->r_squared;
        entry["points"] = growth.law->points;
        entry["from"] = growth.law->from;
    } else {
        entry["exponent"] = nullptr;
    }
    return entry;
}

} // namespace

std::string json_text(const Circumstances& circumstances, const std::vector<Series>& series) {
    Json document{
        {"circumstances", Json::object()}, {"rows", Json::array()}, {"growth", Json::array()}};
    add_fields(document["circumstances"], circumstances);
    for (const Series& one : series) {
        for (const Measurement& row : one.rows) {
            Json entry{{"sweep", to_string(one.sweep)}};
            add_fields(entry, row);
            document["rows"].push_back(std::move(entry));
        }
        for (const Growth& growth : one.growth) {
            document["growth"].push_back(growth_json(one, growth));
        }
    }
    // File and driver names may be anything; text that is not UTF-8 must not end the program.
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string csv_text(const Circumstances& circumstances, const std::vector<Series>& series) {
    std::string text;
    visit_fields(circumstances, [&](const char* name, const auto& value) {
        text += "# " + std::string(name) + ": " + value_text(value) + '\n';
    });
    text += "sweep";
    visit_fields(Measurement{}, [&](const char* name, const auto&) {
        text += ',';
        text += name;
    });
    text += '\n';
    for (const Series& one : series) {
        for (const Measurement& row : one.rows) {
            text += to_string(one.sweep);
            visit_fields(row, [&](const char*, const auto& value) {
                text += ',' + tools::csv_cell(value_text(value));
            });
            text += '\n';
        }
    }
    return text;
}

} // namespace geodisk::bench
