// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/geodesics.hpp"

#include <gtest/gtest.h>
