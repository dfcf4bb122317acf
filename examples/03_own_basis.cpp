// SPDX-License-Identifier: MIT
// A basis of one's own, and the whole `lacuna` command with it.
#include <lacuna/lacuna.hpp>

struct HarmonicsOptions {
  static constexpr lacuna::StageInfo kInfo{"harmonics", "1, v, sin(k v) and cos(k v)", ""};

  int harmonics = 1;

  void describe(lacuna::OptionVisitor& visitor) {
    visitor.field({"harmonics", "", "Largest k.", 1.0, 20.0}, harmonics);
  }
};

class Harmonics final : public lacuna::Configured<lacuna::Basis, HarmonicsOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<lacuna::Term> do_terms(const lacuna::Variables& variables) const override {
    std::vector<lacuna::Term> terms;
    const auto add = [&](const std::string& formula) {
      terms.push_back(lacuna::Term::parse(formula, variables));
    };
    add("1");
    for (const std::string& input : variables.inputs) add(input);
    for (const std::string& state : variables.states) {
      add(state);
      for (int k = 1; k <= options().harmonics; ++k)
        for (const std::string function : {"sin(", "cos("})
          add(function + (k > 1 ? std::to_string(k) + "*" : "") + state + ")");
    }
    return terms;
  }
};

int main(int argc, char** argv) {
  lacuna::Registry registry = lacuna::default_registry();
  registry.add<Harmonics>();
  return lacuna::run_cli(argc, argv, registry);
}
