#pragma once

#include <array>
#include <limits>

// Tables V to IX of Yang, Sega and Harting, "Capillary-bridge forces between solid particles: insights from
// lattice Boltzmann simulations", AIChE Journal 67 (2021) e17350. Volumes V* are in volumes of a sphere of R,
// separations S* in R, forces in R gamma, errors in per cent: (simulation - model) / model. R = 2 r1 r2 /
// (r1 + r2).

namespace pendular::printed {

template <std::size_t Rows, std::size_t Columns>
using Grid = std::array<std::array<double, Columns>, Rows>;

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Tables V: the toroid's volume at the simulation's filling angle, and the error of the simulation's volume.
/// A row for each angle.
struct ToroidVolumes {
    std::array<double, 4> gap;
    Grid<4, 4> volume, error;
};
inline constexpr std::array<double, 4> fiveDegrees{34.6, 48, 60, 74};
inline constexpr ToroidVolumes fiveLarge{.gap = {0.286, 0.572, 0.858, 1.144},
                                         .volume = {{{0.418, 0.534, 0.627, 0.622},
                                                     {0.382, 0.470, 0.557, 0.620},
                                                     {0.366, 0.485, 0.583, 0.657},
                                                     {0.373, 0.503, 0.531, 0.603}}},
                                         .error = {{{-4.4, -6.8, -7.9, 2.44},
                                                    {2.66, 3.13, 3.59, 2.8},
                                                    {5.11, -1.1, -2.1, -3.5},
                                                    {-0.2, -5.8, 6.37, 4.22}}}};
inline constexpr ToroidVolumes fiveSmall{
    .gap = {0.286, 0.428, 0.572, 0.858},
    .volume = {{{0.123, 0.098, 0.103, 0.151},
                {0.107, 0.101, 0.093, 0.145},
                {0.097, 0.072, 0.075, 0.127},
                {0.096, 0.055, 0.055, 0.105}}},
    .error = {{{8.6, 5.6, 4.7, 3.8}, {-2.6, 4.5, 6.9, 8.0}, {7.0, 2.9, 0.7, 2.4}, {-5.7, 9.0, -0.9, 5.5}}}};

/// Table VI, at the gaps of fiveLarge: the simulation's force, and the errors of the models. Two rows of
/// forces lack a number, and what follows stands one column too far left: the row of 34.6 degrees is printed
/// 2.447 2.404 2.307 2.22, that of 60 degrees 0.833 1.529 1.708 1.726. All five models say where they belong.
inline constexpr std::array<double, 4> sixDegrees{19.2, 34.6, 48, 60};
inline constexpr std::array<double, 4> sixNominalVolume{0.40, 0.50, 0.59, 0.65};
inline constexpr Grid<4, 4> sixForce{{{3.03, 2.87, 2.70, 2.52},
                                      {missing, 2.447, 2.404, 2.307},
                                      {1.754, 1.849, 2.026, 2.018},
                                      {0.833, missing, 1.529, 1.708}}};
inline constexpr Grid<4, 4> sixA{{{-0.75, -3.8, -6.9, -5.2},
                                  {-3.0, -5.2, -6.9, -6.6},
                                  {-4.42, -11.5, -7.9, -9.5},
                                  {-22.1, -14.3, -14.0, -12.1}}};
inline constexpr Grid<4, 4> sixB{{{-0.6, -3.4, -6.4, -5.3},
                                  {-2.9, -5.2, -6, -6.8},
                                  {-4.0, -11.1, -7.6, -9.3},
                                  {-21.2, -13, -12.5, -10.5}}};
inline constexpr Grid<4, 4> sixC{
    {{-2.4, 2.74, 6.48, 9.24}, {1.6, 11.5, 18.1, 17.6}, {6.2, 19.9, 38.0, 29.7}, {-20.6, 29.5, 56.9, 42.6}}};
inline constexpr Grid<4, 4> sixD{{{-27.5, -11.3, 3.6, 21.8},
                                  {-36.5, -15.9, 6.7, 29.5},
                                  {-42.9, -20.2, 10.4, 38.9},
                                  {-63.6, -37.9, 11.8, 57.2}}};
inline constexpr Grid<4, 4> sixE{{{-27.4, -24.4, -22.7, -22.2},
                                  {-23.8, -14.3, -7.7, -3.9},
                                  {-22.5, -6.73, 13.32, 23.1},
                                  {-45.9, -2.9, 29, 57.6}}};

/// Table VII, at the first, third and fourth gap of fiveSmall.
inline constexpr std::array<std::size_t, 3> sevenColumns{0, 2, 3};
inline constexpr std::array<double, 3> sevenNominalVolume{0.09, 0.12, 0.15};
inline constexpr Grid<4, 3> sevenForce{
    {{2.527, 1.852, 1.64}, {2.0, 1.583, 1.516}, {1.324, 1.216, 1.242}, {0.747, 0.859, 1.016}}};
inline constexpr Grid<4, 3> sevenA{
    {{-1.73, -0.8, -2.73}, {-5.5, -3.11, -9.06}, {-15.85, -9.55, -2.88}, {-13.81, -15.32, -2.86}}};
inline constexpr Grid<4, 3> sevenB{
    {{-0.68, -4.21, -5.7}, {-5.43, -1.66, -7.74}, {-15.83, -9.31, -2.36}, {-13.41, -15.25, -2.69}}};
inline constexpr Grid<4, 3> sevenC{
    {{-0.66, -3.81, -0.17}, {2.37, -2.41, 2.5}, {-7.86, -8.51, -3.91}, {-19.24, -22.47, -9.86}}};
inline constexpr Grid<4, 3> sevenE{
    {{-25.23, -32.37, -30.12}, {-25.94, -28.13, -17.6}, {-38.58, -31.48, -11.53}, {-53.93, -40.8, 1.26}}};

/// Tables VIII and IX, unequal spheres; a row for each gap, a column for each angle. Table VIII: the
/// simulation's volume and its errors against Chen et al. and against Sun and Sakai. Table IX: the
/// simulation's force and the errors of the two columns, whose headings are swapped (see the tests).
inline constexpr std::array<double, 5> eightGap{0.194, 0.364, 0.486, 0.68, 0.85};
inline constexpr std::array<double, 3> eightDegrees{34.6, 48, 60};
inline constexpr Grid<5, 3> eightVolume{{{0.091, 0.085, 0.074},
                                         {0.098, 0.089, 0.081},
                                         {0.112, 0.108, 0.099},
                                         {0.128, 0.127, 0.118},
                                         {0.130, 0.130, 0.121}}};
inline constexpr Grid<5, 3> eightChen{{{2.11, 7.82, -2.63},
                                       {3.56, 5.20, 8.43},
                                       {-2.56, 4.0, -8.29},
                                       {-6.85, -4.32, -0.47},
                                       {-9.81, -8.64, -9.23}}};
inline constexpr Grid<5, 3> eightSunSakai{
    {{4.9, 8.29, 1.14}, {-4.20, -13.9, -5.2}, {6.03, -1.2, 9.37}, {10.69, 4.53, -5.1}, {12.22, 0, 5.63}}};
inline constexpr Grid<5, 3> nineForce{{{2.631, 1.981, 1.371},
                                       {2.205, 1.789, 1.36},
                                       {1.99, 1.708, 1.367},
                                       {1.755, 1.569, 1.345},
                                       {1.494, 1.404, 1.202}}};
inline constexpr Grid<5, 3> nineHeadedModelC{{{-3.4, -7.55, -14.82},
                                              {-6.52, -11.35, -7.86},
                                              {-3.06, -7.34, -4.41},
                                              {2.8, -4.05, -6.11},
                                              {5.38, -2.74, 3.6}}};
/// The last value is printed -0.623.
inline constexpr Grid<5, 3> nineHeadedChen{{{-3.8, -5.65, -10.9},
                                            {-3.92, -2.77, -4.97},
                                            {-4.05, -0.56, -0.38},
                                            {-1.94, 0.7, 2.1},
                                            {-2.86, -1.31, -6.23}}};

}  // namespace pendular::printed
