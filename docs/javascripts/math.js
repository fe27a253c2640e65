// SPDX-License-Identifier: GPL-3.0-or-later
// Equations: KaTeX typesets what the Markdown marks as TeX, and nothing else.
const delimiters = [
  { left: "\\(", right: "\\)", display: false },
  { left: "\\[", right: "\\]", display: true },
];
for (const element of document.getElementsByClassName("arithmatex")) renderMathInElement(element, { delimiters });
