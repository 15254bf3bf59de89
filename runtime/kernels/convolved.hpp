#pragma once

#include "runtime/kernels/taylor.hpp"
