// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/wire.hpp"

#include <gtest/gtest.h>
