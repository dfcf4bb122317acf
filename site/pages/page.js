// When a page is there: its formulas are set, and what scrolls takes the focus.
document.addEventListener("DOMContentLoaded", () => {
  for (const formula of document.querySelectorAll(".arithmatex"))
    renderMathInElement(formula, {
      delimiters: [{left: "\\(", right: "\\)", display: false},
                   {left: "\\[", right: "\\]", display: true}]});
  for (const wide of document.querySelectorAll("pre > code, .md-typeset__table, .katex-display"))
    wide.tabIndex = 0;
});
