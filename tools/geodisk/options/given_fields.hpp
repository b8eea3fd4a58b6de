// The fields of a request that options set, to refuse those that exclude each other.
#pragma once

#include <array>
#include <string>

#include <geodisk/request_rules.hpp>

namespace geodisk::tools {

/// Fields, with the options that set them.
class GivenFields {
  public:
    /// Notes that an option, as it was given, sets a field.
    void add(RequestField field, const std::string& option, bool is_set = true);
    /// Throws UserError(usage) for two options whose fields exclude each other.
    void check() const;

  private:
    RequestFields fields_;
    std::array<std::string, kRequestFields> options_;
};

} // namespace geodisk::tools
