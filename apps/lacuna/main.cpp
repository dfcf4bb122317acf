// SPDX-License-Identifier: MIT
#include "lacuna/cli/commands/cli.hpp"

int main(int argc, char** argv) { return lacuna::run_cli(argc, argv); }
