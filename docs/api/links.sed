# SPDX-License-Identifier: GPL-3.0-or-later
# Links of the library's guide, as Doxygen needs them: names in headers, and pages of the site that the API reference does not contain. It
# lies in api/cpp of the site.
s#\[`([A-Za-z_]+)`\]\([./]*native/seamwire(_uv)?/include/[^)]*\)#@ref seamwire::\1 "\1"#g
s#\[([^]]+)\]\((\.\./)*(method|benchmarks|notebook|guide)/index\.md[^)]*\)#<a href="../../\3/">\1</a>#g
s#\[([^]]+)\]\((\.\./)*((method|benchmarks|notebook|guide)(/[a-z-]+)?)\.md[^)]*\)#<a href="../../\3/">\1</a>#g
s#\[([^]]+)\]\(\.\./\.\./README\.md[^)]*\)#\1#g
s#\]\(((library/)?[a-z]+\.md)\#[^)]*\)#](\1)#g
s#\[([^]]+)\]\(\#[^)]*\)#\1#g
