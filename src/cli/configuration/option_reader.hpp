// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lacuna/cli/configuration/registry.hpp"

namespace lacuna {

/// Sorted: that of an ordered one looks through all its keys for one.
using Json = nlohmann::json;

/// Fills options from a JSON object, on top of another; strict about names, types and ranges.
class OptionReader final : public OptionVisitor {
 public:
  /// @param base values to start from, `{}` for the defaults; @param given what overrides them;
  /// @param path JSON path of `given`, for messages.
  OptionReader(const Registry& registry, Json base, const Json& given, std::string path);

  void field(const FieldInfo& info, double& value) override;
  void field(const FieldInfo& info, int& value) override;
  void field(const FieldInfo& info, bool& value) override;
  void field(const FieldInfo& info, std::string& value) override;
  void field(const FieldInfo& info, std::optional<double>& value) override;
  void field(const FieldInfo& info, std::optional<int>& value) override;
  void field(const FieldInfo& info, std::vector<std::string>& value) override;

  /// @throws ConfigError for a key that is no option, with the nearest one that is.
  void check_all_known(const std::string& owner) const;

 protected:
  void choice(const FieldInfo& info, std::span<const std::string_view> names,
              int& index) override;
  void nested_stage(const FieldInfo& info, std::string_view kind,
                    std::shared_ptr<const StageInterface>& stage) override;

 private:
  /// The value that counts for a field, if there is one.
  const Json* find(const FieldInfo& info);
  std::string path_of(const FieldInfo& info) const;
  double number(const FieldInfo& info, const Json& value) const;
  int integer(const FieldInfo& info, const Json& value) const;
  [[noreturn]] void wrong_type(const FieldInfo& info, const std::string& expected,
                               const Json& value) const;

  const Registry& registry_;
  Json base_;
  const Json& given_;
  std::string path_;
  std::vector<std::string> known_;
};

/// Makes the stage that `given` describes: a name, or an object of an optional "type" and
/// options.
/// @param present the stage to change: with its type or without a type its options are kept.
/// @throws ConfigError naming the JSON path.
std::shared_ptr<const StageInterface> read_stage(const Registry& registry,
                                                 std::string_view kind, const Json& given,
                                                 const std::string& path,
                                                 const StageInterface& present);

}  // namespace lacuna
