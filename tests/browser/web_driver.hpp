// A browser, driven by the protocol of W3C WebDriver.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace geodisk::test {

using Json = nlohmann::json;

/// A headless Chromium of its own, which draws WebGL on the CPU. All members throw
/// std::runtime_error for what the driver refuses.
class Browser {
  public:
    /// With `switches` besides those it always has.
    explicit Browser(const std::vector<std::string>& switches = {});
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    /// Shows pages from now on as a phone of so many pixels does, with the colours of `scheme`,
    /// light or dark.
    void emulate(int width, int height, const std::string& scheme);

    /// Opens a file of this computer and waits until it is ready, as its script says.
    void open(const std::filesystem::path& path);

    /// Returns what `script` returns, a body of a function in JavaScript.
    Json eval(const std::string& script);
    /// The same of one that hands over its result by calling done(result).
    Json eval_later(const std::string& script);

    /// Waits until `condition`, an expression in JavaScript, is true, up to some seconds.
    void wait_for(const std::string& condition);

    /// Moves the mouse to a place in the element, from its middle on, in pixels.
    void move_to(const std::string& element_id, int x, int y);
    /// The same with a button pressed on the way from where it is; `button` as in JavaScript.
    void drag(const std::string& element_id, int x, int y, int button = 0);
    void scroll(const std::string& element_id, int y);
    void press(const std::string& key);

    /// Writes a picture of an element as PNG.
    void take_picture(const std::string& element_id, const std::filesystem::path& path);

    /// Returns what was written to the console since the last call.
    std::vector<std::string> console();

  private:
    Json find(const std::string& element_id);
    Json command(const std::string& name, const Json& parameters);
    void act(const Json& actions);

    class Driver;
    std::unique_ptr<Driver> driver_;
    std::string session_;
};

} // namespace geodisk::test
