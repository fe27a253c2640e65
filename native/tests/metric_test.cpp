// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/metric.hpp"

#include <gtest/gtest.h>
