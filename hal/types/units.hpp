#pragma once

#include <numbers>

/// The only conversion factors in the house. rpm and degrees live at the edges (roles, plans,
/// reports); sim and analysis compute in SI.
namespace rvbench::units {

inline constexpr double two_pi = 2 * std::numbers::pi;
inline constexpr double standard_gravity_m_s2 = 9.80665;
inline constexpr double inch_m = 0.0254;
inline constexpr double foot_m = 0.3048;
inline constexpr double pound_force_N = 0.45359237 * standard_gravity_m_s2;
inline constexpr double kilogram_force_N = standard_gravity_m_s2;
inline constexpr double degree_rad = two_pi / 360;

constexpr double rad_s_from_rpm(double rpm) { return rpm * two_pi / 60; }
constexpr double rpm_from_rad_s(double rad_s) { return rad_s * 60 / two_pi; }
constexpr double Hz_from_rpm(double rpm) { return rpm / 60; }
constexpr double rpm_from_Hz(double hz) { return hz * 60; }
constexpr double g_from_m_s2(double m_s2) { return m_s2 / standard_gravity_m_s2; }
constexpr double m_s2_from_g(double g) { return g * standard_gravity_m_s2; }
constexpr double arcsec_from_rad(double rad) { return rad * 360 * 3600 / two_pi; }
constexpr double arcmin_from_rad(double rad) { return rad * 360 * 60 / two_pi; }
constexpr double rad_from_arcmin(double arcmin) { return arcmin * two_pi / (360 * 60); }
constexpr double rad_from_arcsec(double arcsec) { return arcsec * two_pi / (360 * 3600); }

}  // namespace rvbench::units
