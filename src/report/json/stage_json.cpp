// SPDX-License-Identifier: MIT
#include "report/json/stage_json.hpp"

#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

Json stage_to_json(const StageInterface& stage);

/// Writes every option into a JSON object.
class OptionWriter final : public OptionVisitor {
 public:
  explicit OptionWriter(Json& object) : object_(object) {}
  void field(const FieldInfo& info, double& value) override { put(info, value); }
  void field(const FieldInfo& info, int& value) override { put(info, value); }
  void field(const FieldInfo& info, bool& value) override { put(info, value); }
  void field(const FieldInfo& info, std::string& value) override { put(info, value); }
  void field(const FieldInfo& info, std::optional<double>& value) override {
    put(info, value ? Json(*value) : Json(nullptr));
  }
  void field(const FieldInfo& info, std::optional<int>& value) override {
    put(info, value ? Json(*value) : Json(nullptr));
  }
  void field(const FieldInfo& info, std::vector<std::string>& value) override {
    put(info, value);
  }

 protected:
  void choice(const FieldInfo& info, std::span<const std::string_view> names,
              int& index) override {
    put(info, std::string(names[static_cast<std::size_t>(index)]));
  }
  void nested_stage(const FieldInfo& info, std::string_view,
                    std::shared_ptr<const StageInterface>& stage) override {
    put(info, stage_to_json(*stage));
  }

 private:
  void put(const FieldInfo& info, Json value) {
    object_[std::string(info.name)] = std::move(value);
  }
  Json& object_;
};

Json stage_to_json(const StageInterface& stage) {
  Json object;
  object["type"] = std::string(stage.info().name);
  OptionWriter writer(object);
  stage.visit_options(writer);
  return object;
}

}  // namespace

std::string format_stage(const StageInterface& stage) {
  return json_line(stage_to_json(stage));
}

std::string format_pipeline(const Pipeline& pipeline) {
  Json object;
  object["basis"] = stage_to_json(*pipeline.basis);
  object["formulation"] = stage_to_json(*pipeline.formulation);
  object["filter"] = stage_to_json(*pipeline.filter);
  object["regressor"] = stage_to_json(*pipeline.regressor);
  object["pruner"] = stage_to_json(*pipeline.pruner);
  object["refiner"] = stage_to_json(*pipeline.refiner);
  return json_line(object);
}

}  // namespace lacuna
