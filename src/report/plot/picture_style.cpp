// SPDX-License-Identifier: MIT
#include "report/plot/figure.hpp"

namespace lacuna {

// Colours are distinguished by those who do not see red and green (Okabe and Ito 2008).
std::string picture_style() {
  return R"(:root{--ink:#1b1f24;--soft:#57606a;--paper:#ffffff;--grid:#e3e7eb;
--measured:#57606a;--before:#d55e00;--model:#0072b2;--other:#cc79a7;--band:#0072b222}
@media (prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#a2abb5;--paper:#14171b;
--grid:#2b3138;--measured:#b4bcc6;--before:#ff9249;--model:#5cb8f5;--other:#e6a5c8;
--band:#5cb8f530}}
@media print{:root{--ink:#000;--soft:#444;--paper:#fff;--grid:#ddd;--measured:#555;
--before:#d55e00;--model:#0072b2;--other:#cc79a7;--band:#0072b222}}
.picture{font:12px system-ui,"Segoe UI","Liberation Sans",sans-serif;background:var(--paper)}
.picture text{fill:var(--ink)}.picture .tick{fill:var(--soft);font-size:11px}
.picture .title{font-size:13px;font-weight:600}.picture .axis{fill:var(--soft)}
.picture .grid{stroke:var(--grid);stroke-width:1}.picture .zero{stroke:var(--soft)}
.picture .band{fill:var(--band)}.picture .band-key{stroke:var(--band);stroke-width:10}
.picture .curve{fill:none;stroke-width:1.4;stroke-linejoin:round}
.picture .dots{stroke-width:4;stroke-linecap:round;opacity:.5}
.picture .measured{stroke:var(--measured)}.picture .before{stroke:var(--before)}
.picture .model{stroke:var(--model)}.picture .other{stroke:var(--other)}
.picture .curve.band-key{stroke-width:10}
.picture .bar{fill:var(--soft);opacity:.55}.picture .bar.marked{fill:var(--model);opacity:1}
.picture .whisker{stroke:var(--soft);stroke-width:1.6}.picture .dot{fill:var(--soft)}
.picture .whisker.marked{stroke:var(--model)}.picture .dot.marked{fill:var(--model)}
.picture .heat{fill:var(--model)}
.picture .key{cursor:pointer}.picture .off{opacity:.15}
)";
}

std::string stand_alone(const Picture& picture) {
  const std::string& svg = picture.svg.string();
  const std::size_t inside = svg.find('>') + 1;
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg.substr(0, inside) + "<style>" +
         picture_style() + "</style>" + svg.substr(inside) + "\n";
}

}  // namespace lacuna
