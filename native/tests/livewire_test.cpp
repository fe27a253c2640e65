// SPDX-License-Identifier: GPL-3.0-or-later
#include "seamwire/livewire.hpp"

#include <gtest/gtest.h>
