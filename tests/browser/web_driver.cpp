#include "browser/web_driver.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <doctest/doctest.h>

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/base64.hpp"

namespace geodisk::test {
namespace {

constexpr std::string_view kBrowser = GEODISK_CHROMIUM, kDriver = GEODISK_CHROMEDRIVER;
constexpr auto kPatience = std::chrono::seconds(60);
/// Key that identifies elements in JSON.
constexpr const char* kElement = "element-6066-11e4-a52e-4f735466cecf";

[[noreturn]] void fail(const std::string& message) {
    throw std::runtime_error("browser: " + message);
}

/// A file descriptor that is closed at the end.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {
        if (number < 0) {
            fail("no descriptor");
        }
    }
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }

    /// Reads on until `is_enough(text)` is true of what was read, or until the end.
    template <class IsEnough>
    std::string read_until(const IsEnough& is_enough) const {
        std::string text;
        char bytes[65536];
        while (!is_enough(text)) {
            const ssize_t count = read(number_, bytes, sizeof bytes);
            if (count <= 0) {
                break;
            }
            text.append(bytes, static_cast<std::size_t>(count));
        }
        return text;
    }

  private:
    int number_;
};

/// Returns true if an HTTP response has as many bytes as it says.
bool is_whole(const std::string& response) {
    const std::string name = "Content-Length:";
    const std::size_t end = response.find("\r\n\r\n");
    const std::size_t length = response.find(name);
    return end != std::string::npos && length < end &&
           response.size() >= end + 4 + std::stoul(response.substr(length + name.size()));
}

/// Returns the body of an HTTP response that is complete.
Json body_of(const std::string& response) {
    const std::size_t end = response.find("\r\n\r\n");
    if (end == std::string::npos) {
        fail("the driver did not answer");
    }
    const Json body = Json::parse(response.substr(end + 4));
    const Json& value = body.at("value");
    if (value.is_object() && value.contains("error")) {
        fail(value.value("error", "") + ": " + value.value("message", ""));
    }
    return value;
}

} // namespace

/// The process of chromedriver, which ends with the object.
class Browser::Driver {
  public:
    Driver() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) {
            fail("no pipe");
        }
        process_ = fork();
        if (process_ == 0) {
            dup2(ends[1], STDOUT_FILENO);
            setpgid(0, 0);
            execl(kDriver.data(), kDriver.data(), "--port=0", nullptr);
            _exit(127);
        }
        close(ends[1]);
        out_ = std::make_unique<Descriptor>(ends[0]);
        const std::string mark = "successfully on port ";
        const std::string told = out_->read_until([&](const std::string& text) {
            const std::size_t begin = text.find(mark); // The number ends with a dot.
            return begin != std::string::npos && text.find('.', begin) != std::string::npos;
        });
        const std::size_t at = told.find(mark);
        if (at == std::string::npos) {
            fail("chromedriver did not start: " + told);
        }
        port_ = static_cast<std::uint16_t>(std::stoul(told.substr(at + mark.size())));
    }
    ~Driver() {
        kill(-process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    Json request(const std::string& method, const std::string& path,
                 const std::string& body) const {
        const Descriptor connection(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        const timeval patience{kPatience.count(), 0};
        setsockopt(connection.number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port_);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (connect(connection.number(), reinterpret_cast<const sockaddr*>(&address),
                    sizeof address) != 0) {
            fail("chromedriver cannot be reached");
        }
        std::string text = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" +
                           "Connection: close\r\nContent-Type: application/json\r\n" +
                           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
        for (std::string_view rest = text; !rest.empty();) {
            const ssize_t count = write(connection.number(), rest.data(), rest.size());
            if (count < 0) {
                fail("chromedriver takes no request");
            }
            rest.remove_prefix(static_cast<std::size_t>(count));
        }
        return body_of(connection.read_until(is_whole));
    }

  private:
    pid_t process_ = -1;
    std::unique_ptr<Descriptor> out_; ///< Its standard output, which it may write to on and on.
    std::uint16_t port_ = 0;
};

Browser::Browser(const std::vector<std::string>& switches) : driver_(std::make_unique<Driver>()) {
    Json given = {"--headless=new",
                  "--no-sandbox", // It does not start as root otherwise.
                  "--use-angle=swiftshader",
                  "--enable-unsafe-swiftshader",
                  "--window-size=1200,900",
                  "--force-device-scale-factor=1",
                  "--disable-background-networking"};
    for (const std::string& one : switches) {
        given.push_back(one);
    }
    const Json capabilities = {
        {"goog:chromeOptions", {{"binary", std::string(kBrowser)}, {"args", given}}},
        {"goog:loggingPrefs", {{"browser", "ALL"}}}};
    const Json session = driver_->request(
        "POST", "/session", Json{{"capabilities", {{"alwaysMatch", capabilities}}}}.dump());
    session_ = session.at("sessionId").get<std::string>();
}

Browser::~Browser() {
    try {
        driver_->request("DELETE", "/session/" + session_, "");
    } catch (const std::exception&) {
        // It ends with its driver.
    }
}

Json Browser::command(const std::string& name, const Json& parameters) {
    return driver_->request("POST", "/session/" + session_ + "/" + name, parameters.dump());
}

void Browser::emulate(int width, int height, const std::string& scheme) {
    command("goog/cdp/execute",
            {{"cmd", "Emulation.setDeviceMetricsOverride"},
             {"params",
              {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", true}}}});
    const Json feature{{"name", "prefers-color-scheme"}, {"value", scheme}};
    command("goog/cdp/execute", {{"cmd", "Emulation.setEmulatedMedia"},
                                 {"params", {{"features", Json::array({feature})}}}});
}

void Browser::open(const std::filesystem::path& path) {
    command("url", {{"url", "file://" + path.string()}});
    wait_for("document.documentElement.dataset.ready === 'true'");
}

Json Browser::eval(const std::string& script) {
    return command("execute/sync", {{"script", script}, {"args", Json::array()}});
}

Json Browser::eval_later(const std::string& script) {
    return command("execute/async",
                   {{"script", "const done = arguments[0];" + script}, {"args", Json::array()}});
}

void Browser::wait_for(const std::string& condition) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!eval("return Boolean(" + condition + ");").get<bool>()) {
        if (std::chrono::steady_clock::now() > end) {
            fail("waited in vain for " + condition);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

Json Browser::find(const std::string& element_id) {
    return command("element", {{"using", "css selector"}, {"value", "#" + element_id}});
}

void Browser::act(const Json& actions) {
    command("actions", {{"actions", actions}});
}

void Browser::move_to(const std::string& element_id, int x, int y) {
    act({{{"type", "pointer"},
          {"id", "mouse"},
          {"parameters", {{"pointerType", "mouse"}}},
          {"actions",
           {{{"type", "pointerMove"},
             {"duration", 50},
             {"origin", find(element_id)},
             {"x", x},
             {"y", y}}}}}});
}

void Browser::drag(const std::string& element_id, int x, int y, int button) {
    act({{{"type", "pointer"},
          {"id", "mouse"},
          {"parameters", {{"pointerType", "mouse"}}},
          {"actions",
           {{{"type", "pointerDown"}, {"button", button}},
            {{"type", "pointerMove"},
             {"duration", 200},
             {"origin", find(element_id)},
             {"x", x},
             {"y", y}},
            {{"type", "pointerUp"}, {"button", button}}}}}});
}

void Browser::scroll(const std::string& element_id, int y) {
    act({{{"type", "wheel"},
          {"id", "wheel"},
          {"actions",
           {{{"type", "scroll"},
             {"origin", find(element_id)},
             {"x", 0},
             {"y", 0},
             {"deltaX", 0},
             {"deltaY", y}}}}}});
}

void Browser::press(const std::string& key) {
    act({{{"type", "key"},
          {"id", "keys"},
          {"actions",
           {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}}}}});
}

void Browser::take_picture(const std::string& element_id, const std::filesystem::path& path) {
    const std::string element = find(element_id).at(kElement).get<std::string>();
    const Json base64 =
        driver_->request("GET", "/session/" + session_ + "/element/" + element + "/screenshot", "");
    const std::string bytes = bytes_of_base64(base64.get<std::string>());
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

std::vector<std::string> Browser::console() {
    std::vector<std::string> lines;
    for (const Json& entry : command("se/log", {{"type", "browser"}})) {
        lines.push_back(entry.at("level").get<std::string>() + " " +
                        entry.at("message").get<std::string>());
    }
    return lines;
}

} // namespace geodisk::test
