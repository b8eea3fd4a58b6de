// Task: a coroutine that suspends while it waits for the device.
#pragma once

#include <coroutine>
#include <exception>
#include <optional>
#include <utility>

namespace geodisk {

/// Owns a coroutine that returns a T. It starts when it is first resumed or awaited. Whoever awaits
/// it continues with its result or exception. Destroying the task destroys everything in the
/// coroutine's frame.
template <class T>
class [[nodiscard]] Task {
  public:
    struct promise_type {
        std::optional<T> value;
        std::exception_ptr exception;
        std::coroutine_handle<> awaiting = std::noop_coroutine();

        Task get_return_object() {
            return Task(std::coroutine_handle<promise_type>::from_promise(*this));
        }
        std::suspend_always initial_suspend() noexcept { return {}; }
        auto final_suspend() noexcept {
            struct GoOn {
                bool await_ready() noexcept { return false; }
                std::coroutine_handle<>
                await_suspend(std::coroutine_handle<promise_type> own) noexcept {
                    return own.promise().awaiting;
                }
                void await_resume() noexcept {}
            };
            return GoOn{};
        }
        template <class Value>
        void return_value(Value&& returned) {
            value.emplace(std::forward<Value>(returned));
        }
        void unhandled_exception() noexcept { exception = std::current_exception(); }
    };

    Task(Task&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Task& operator=(Task&&) = delete;
    ~Task() {
        if (handle_) {
            handle_.destroy();
        }
    }

    /// Starts the coroutine.
    void resume() const { handle_.resume(); }
    bool is_done() const { return handle_.done(); }
    /// Returns the result of the completed coroutine, or rethrows its exception.
    T take() const {
        promise_type& promise = handle_.promise();
        if (promise.exception) {
            std::rethrow_exception(promise.exception);
        }
        return std::move(*promise.value);
    }

    bool await_ready() const noexcept { return false; }
    std::coroutine_handle<> await_suspend(std::coroutine_handle<> awaiting) const noexcept {
        handle_.promise().awaiting = awaiting;
        return handle_;
    }
    T await_resume() const { return take(); }

  private:
    explicit Task(std::coroutine_handle<promise_type> handle) : handle_(handle) {}
    std::coroutine_handle<promise_type> handle_;
};

} // namespace geodisk
