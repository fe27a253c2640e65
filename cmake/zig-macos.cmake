# SPDX-License-Identifier: GPL-3.0-or-later
# Zig's linker makes no bundles; Python loads dynamic libraries as well.
set(CMAKE_SHARED_MODULE_CREATE_CXX_FLAGS "-dynamiclib -Wl,-headerpad_max_install_names")
