// Keeps a function a call. Products of polynomials, written out at each of some hundred places in a
// formula and for a dozen kinds of numbers, take most of the time in which certificates compile,
// and make them no faster (results/building.md).
#pragma once

#define MISALIGN_CALL [[gnu::noinline]]
