#include "geodisk/batch/batch_log.hpp"

#include <filesystem>
#include <string_view>
#include <system_error>

#include "files/input_file.hpp"
#include "files/text_lines.hpp"
#include "geodisk/reports/json.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kOk = "ok";

/// The command of a line about a mesh that is done, else "".
std::string command_done(std::string_view line) {
    const Json entry = Json::parse(line, nullptr, false);
    if (!entry.is_object() || !entry.contains("status") || !entry.contains("command") ||
        entry["status"] != kOk || !entry["command"].is_string()) {
        return "";
    }
    return entry["command"].get<std::string>();
}

bool is_log(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    return name == "batch.jsonl" || (name.starts_with("batch-") && name.ends_with(".jsonl"));
}

} // namespace

void check_no_log(const std::string& path) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(Path(path), ignored);
    if (!ignored && size > 0) { // Without a line there is nothing to lose.
        fail_usage(
            path +
            ": there is a log already; continue that batch with --resume, or give another folder");
    }
}

std::set<std::string> commands_done(const std::string& folder) {
    std::set<std::string> done;
    std::error_code ignored;
    for (const auto& file : std::filesystem::directory_iterator(Path(folder), ignored)) {
        if (!is_log(file.path())) {
            continue;
        }
        const std::string text = read_file(file.path());
        TextLines lines(text);
        for (std::string_view line; lines.next(line);) {
            if (std::string command = command_done(line); !command.empty()) {
                done.insert(std::move(command));
            }
        }
    }
    return done;
}

void append_entry(LineLog& log, const BatchEntry& entry) {
    Json json{{"mesh", entry.mesh},
              {"output", entry.output},
              {"status", entry.is_ok() ? kOk : "failed"},
              {"exit_code", entry.exit_code}};
    if (entry.is_ok()) {
        json["samples"] = entry.samples;
        json["min_distance"] = entry.min_distance;
    } else {
        json["error"] = entry.error;
    }
    json.update({{"seconds", entry.seconds}, {"warnings", entry.warnings}});
    if (!entry.device.empty()) {
        json["device"] = entry.device;
    }
    json["command"] = entry.command;
    log.append(json_text(json, -1));
}

} // namespace geodisk::tools
