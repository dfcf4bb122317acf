// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// What a user asks of a pipeline: a JSON document that overrides a preset stage by stage.
///
///   {"preset": "algorithm1", "tolerances": "paper",
///    "basis": {"type": "monomials", "max_degree": 3},
///    "differentiator": {"order": 6},
///    "regressor": {"type": "irls-l1", "inner": "ceres"}}
///
/// A stage is an object, or just its name. With the type the preset has, or without a type, it
/// keeps the preset's options and changes those given; another type starts at that type's
/// defaults. `differentiator` is short for `formulation.differentiator`. Options
/// that belong to no stage are objects beside these (identification_options()). Whatever is
/// said later wins over what was said before, but an option of a command line (all below that
/// read no text) over another option: where these differ that is a ConfigError.
class Configuration {
 public:
  Configuration();  ///< nothing is asked for
  Configuration(const Configuration& other);
  Configuration& operator=(const Configuration& other);
  ~Configuration();

  /// Takes over all that a JSON text says. @param source name for messages.
  /// @throws ConfigError with line and column where it is not a JSON object.
  void merge_text(std::string_view json, const std::string& source);

  /// Reads a JSON file. @throws FileError, ConfigError.
  void merge_file(const std::string& path);

  /// Sets one value, "regressor.threshold=0.05", "regressor=stlsq"; the value is JSON, or else
  /// text. @throws ConfigError when it is not PATH=VALUE.
  void set(std::string_view assignment);

  /// Names the preset to start from.
  void set_preset(const std::string& name);

  /// A map x[n+1] = f(x[n]) instead of a flow: the formulation `next-sample`, no refiner.
  void set_discrete();

  /// The monomial library up to a degree, with any options given for it before.
  void set_degree(int degree);

  /// The candidate terms outright, "sign(q_d1),1,F".
  void set_terms(std::string_view list);

  /// Terms beside those of the library, "sin(th),x*abs(x)"; for the basis `monomials`.
  void add_terms(std::string_view list);

  /// One value that an option of its own gives: "--max-effects 3", "decision.max_effects", "3".
  void set_by(const std::string& option, std::string_view path, std::string_view json);

  /// The terms of one equation, "dw: sin(th),w,u". @throws ConfigError without the colon.
  void set_equation(std::string_view text);

  /// What coefficients have to satisfy: "y: x*z, z: x*y = 0" (their sum is 0), "y: x, -2 z: w =
  /// 0", "dth: w = 1" (fixed), or "energy-preserving".
  void add_constraint(const std::string& text);

  /// What was asked for, as JSON text.
  std::string text() const;

  /// Whether anything was asked for that makes the pipeline another than the default.
  bool says_pipeline() const;

  /// Whether anything was asked for under a key: "regressor", "pruner".
  bool says(std::string_view key) const;

  /// The pipeline. @throws ConfigError naming the JSON path: an unknown key or name (with the
  /// nearest known one), a value of the wrong type or out of range, a part that is unavailable.
  Pipeline build(const Registry& registry) const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace lacuna
