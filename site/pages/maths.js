// Formulas of a page, set when it is there.
document.addEventListener("DOMContentLoaded", () => {
  for (const formula of document.querySelectorAll(".arithmatex"))
    renderMathInElement(formula, {
      delimiters: [{left: "\\(", right: "\\)", display: false},
                   {left: "\\[", right: "\\]", display: true}]});
});
