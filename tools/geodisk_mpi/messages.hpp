// Messages among the processes of a run, and the one way in which their errors spread.
//
// An error is thrown as UserError where it arises. agree() and check() tell all processes of it,
// which then throw it as SharedError: the first process ends with it, the others go on to what the
// first one calls next. Results of the library are the same on all processes; known() throws their
// errors likewise. Anything else that an operation throws is known to one process alone, and ends
// all: see Session.
#pragma once

#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/status.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

/// An error that all processes know.
class SharedError : public UserError {
  public:
    using UserError::UserError;
    explicit SharedError(const UserError& error) : UserError(error) {}
};

/// Returns a status that exit_code_of() turns into the same code, as far as there is one.
inline Status status_of(ExitCode code) {
    for (const Status status : {Status::invalid_argument, Status::mesh_rejected, Status::no_device,
                                Status::out_of_device_memory}) {
        if (exit_code_of(status) == code) {
            return status;
        }
    }
    return Status::internal;
}

/// An exchange of records. All processes make the same calls.
class Messages {
  public:
    explicit Messages(Exchange& exchange) : exchange_(exchange) {}

    std::uint32_t rank() const { return exchange_.rank(); }
    std::uint32_t size() const { return exchange_.size(); }
    bool is_first() const { return rank() == 0; }

    /// Returns what the first process gives.
    template <class Record>
    Record broadcast(const Record& of_first) {
        return broadcast_all(std::span(&of_first, 1)).front();
    }
    template <class Record>
    std::vector<Record> broadcast_all(std::span<const Record> of_first) {
        return records_of<Record>(known(exchange_.broadcast(bytes_of(of_first))));
    }
    /// Returns the message that the first process has for this one. It gives one for each process.
    Bytes scatter(std::vector<Bytes> messages) {
        return known(exchange_.scatter(std::move(messages)));
    }
    /// Returns the records of all processes at the first one, by process; nothing elsewhere.
    template <class Record>
    std::vector<std::vector<Record>> gather(std::span<const Record> own) {
        std::vector<std::vector<Record>> all;
        for (const Bytes& message : known(exchange_.gather(bytes_of(own)))) {
            all.push_back(records_of<Record>(message));
        }
        return all;
    }
    /// Returns the records that all processes give, in their order.
    template <class Record>
    std::vector<Record> all_gather(const Record& own) {
        return known(exchange_.all_gather(own));
    }

    /// Returns what `work` returns, or what it throws as an error that check() or the library tells
    /// all processes of.
    template <class Work>
    Result<std::invoke_result_t<Work>> caught(const Work& work) {
        try {
            return work();
        } catch (const UserError& error) {
            own_ = error;
            return Error{status_of(error.code()), error.what()};
        } catch (const std::bad_alloc&) {
            return Error{Status::out_of_host_memory, "out of memory"};
        }
    }
    /// Returns the value. Throws SharedError on all processes if one has an error.
    template <class T>
    T check(Result<T> own) {
        known(exchange_.check_all(own ? nullptr : &own.error()));
        return std::move(*own);
    }
    /// Does the same with the error that `fail` throws.
    template <class T, class Fail>
    T check(Result<T> own, const Fail& fail) {
        known(exchange_.check_all(own ? nullptr : &own.error()), fail);
        return std::move(*own);
    }
    /// Returns what `work` returns, which each process does on its own. Throws SharedError on all
    /// processes if it throws UserError or std::bad_alloc on one.
    template <class Work>
    std::invoke_result_t<Work> agree(const Work& work) {
        return check(caught(work));
    }
    /// Returns the value of a result that fails on all processes or none. Throws SharedError.
    template <class T>
    T known(Result<T> result) {
        check_own(result);
        return known(std::move(result), [](const Error& error) { take(Result<Done>(error)); });
    }
    /// Does the same with the error that `fail` throws.
    template <class T, class Fail>
    static T known(Result<T> result, const Fail& fail) {
        if (!result) {
            try {
                fail(result.error());
            } catch (const UserError& error) {
                throw SharedError(error);
            }
        }
        return std::move(*result);
    }
    /// Throws the first process's own error if the result failed by it. Other processes know only
    /// the message.
    template <class T>
    void check_own(const Result<T>& result) {
        if (own_ && !result && is_first()) {
            throw SharedError(*std::exchange(own_, std::nullopt));
        }
    }

  private:
    Exchange& exchange_;
    std::optional<UserError> own_; ///< Latest error of this process that caught() returned.
};

} // namespace geodisk::tools
