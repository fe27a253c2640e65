# SPDX-License-Identifier: GPL-3.0-or-later
# Links of the library's guide, as Doxygen needs them: names in headers, and pages that the API reference does not contain.
s#\[`([A-Za-z_]+)`\]\([./]*native/include/[^)]*\)#@ref seamwire::\1 "\1"#g
s#\[([^]]+)\]\((\.\./)*(method|benchmarks|guide|automatic-seams)\.md[^)]*\)#<a href="../../../docs/\3.md">\1</a>#g
s#\[([^]]+)\]\(\.\./\.\./README\.md\)#<a href="../../../README.md">\1</a>#g
s#\]\(((library/)?[a-z]+\.md)\#[^)]*\)#](\1)#g
