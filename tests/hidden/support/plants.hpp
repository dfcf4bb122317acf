// SPDX-License-Identifier: MIT
#pragma once

#include "hidden/support/hidden_case.hpp"

// The systems of the hidden cases, as their engineers describe them (nothing hidden yet).
namespace lacuna::hidden::plants {

Plant pendulum();         ///< th, w; torque u
Plant oscillator();       ///< mass x, v on a spring; force u
Plant double_well();      ///< buckled beam q, v; force u
Plant stage();            ///< positioning stage x, v with soft return spring; force u
Plant motor();            ///< DC motor: speed w, current i; voltage u
Plant servo_arm();        ///< th, w; angle u of the drive
Plant geared_drive();     ///< motor speed w1, shaft twist d, load speed w2; torque u
Plant rigid_body();       ///< w1, w2, w3 with three torques
Plant two_oscillators();  ///< x1, v1, x2, v2: self-excited, not coupled
Plant coupled_masses();   ///< x1, v1, x2, v2 on springs to each other and the ground; force u
Plant turntable();        ///< th, w, as far as it goes; torque u
Plant hydraulic();        ///< piston v, pressure p; valve u

Plant series_rlc();    ///< current i, capacitor voltage v; source u
Plant parallel_rlc();  ///< flux lam, voltage v; source u
Plant filter_loop();   ///< two integrators x, y in a loop; input u
Plant van_der_pol();   ///< q, v, free
Plant chua_linear();   ///< Chua's circuit with a linear negative resistor
Plant rossler();       ///< Rossler's circuit
Plant lorenz();        ///< Lorenz's flow

Plant two_tanks();      ///< levels h1, h2; pump u
Plant linear_tanks();   ///< levels h1, h2 coupled by a laminar pipe; pump u
Plant heater();         ///< temperatures T1, T2; power u
Plant prey_predator();  ///< x, y; growth varies with the weather u
Plant enzyme();         ///< substrate s, product p; feed u
Plant nerve();          ///< FitzHugh-Nagumo v, w; current u

}  // namespace lacuna::hidden::plants
