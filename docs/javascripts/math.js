// SPDX-License-Identifier: GPL-3.0-or-later
// Equations: MathJax typesets what the Markdown marks as TeX, and nothing else; again after each page that loads without a reload.
window.MathJax = {
  tex: { inlineMath: [["\\(", "\\)"]], displayMath: [["\\[", "\\]"]], processEscapes: true },
  options: { ignoreHtmlClass: ".*|", processHtmlClass: "arithmatex" },
};
