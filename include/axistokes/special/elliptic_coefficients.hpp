// SPDX-License-Identifier: MIT
// Polynomial coefficients, lowest power first, of the fast paths of elliptic.hpp and ring_integrals.hpp.
//
// Each function f(m1) on (0, 1] is P(m1) - log(m1) Q(m1) with the polynomials that minimise the maximal relative error,
// found by Remez exchange in 60 digits on the Chebyshev system {x^i, x^j log x}; the leading behaviour at m1 = 0 is
// fixed to its exact value (docs/free_space_kernel.md, section 4). Only float and double have a fit.
#pragma once

#include <array>
#include <cstddef>

namespace axistokes::detail {

/// K = pk - qk log(m1), E = pe - m1 qe log(m1): minimax coefficients, all positive, hence no cancellation.
template <class S>
struct EllipticFit {
    static constexpr bool available = false;
};

/// Maximal relative error 3.2e-18.
template <>
struct EllipticFit<double> {
    static constexpr bool available = true;
    static constexpr std::array<double, 11> pk{
        1.3862943611198906188,    0.096573590281480244958,  0.030885147053622958218,  0.01493813610643779759,
        0.0087943316867917466427, 0.0062294158923766380859, 0.0070128073672818061078, 0.0099337463063615737542,
        0.0078266072566176108724, 0.0021794830785776973054, 0.00012870064545792484903};
    static constexpr std::array<double, 11> qk{0.5,
                                               0.12499999999983974504,
                                               0.070312499613939328041,
                                               0.048828015145035081998,
                                               0.037376377343998538832,
                                               0.030102832172683926949,
                                               0.023803030311353337977,
                                               0.015246367034934480384,
                                               0.0057470274155034281812,
                                               0.00086659919972077399837,
                                               0.000027312941747443654214};
    static constexpr std::array<double, 11> pe{1.0,
                                               0.44314718056075356396,
                                               0.056805194349727370818,
                                               0.021831771004884369201,
                                               0.011567870807128213795,
                                               0.0075737919074956143606,
                                               0.007741486955489153234,
                                               0.010719362917607429822,
                                               0.0087225837568226477676,
                                               0.0025314987872206833207,
                                               0.0001555857477675680098};
    static constexpr std::array<double, 10> qe{
        0.24999999999991618493,   0.093749999754943158829,   0.058593669851108958638, 0.042718391246685525598,
        0.033487967538247527662,  0.026202888392016069476,   0.016942218055276009242, 0.0065501307409960425712,
        0.0010202038306469017178, 0.000033252705723914357693};
};

/// Maximal relative error 3e-10.
template <>
struct EllipticFit<float> {
    static constexpr bool available = true;
    static constexpr std::array<float, 6> pk{1.38629436112F,   0.0965804478836F, 0.0316716847704F,
                                             0.0242688981423F, 0.025691686528F,  0.00628924816783F};
    static constexpr std::array<float, 6> qk{
        0.5F, 0.124999011682F, 0.0701158357087F, 0.044627144217F, 0.0181656130489F, 0.00173500003823F};
    static constexpr std::array<float, 6> pe{
        1.0F, 0.443152117835F, 0.0575045743897F, 0.0313988780346F, 0.030802535983F, 0.00793822009363F};
    static constexpr std::array<float, 5> qe{0.249999314353F, 0.0935820526451F, 0.0544873608508F, 0.0222716194072F,
                                             0.00221977086689F};
};

/// h = ph - qh log(m1), c = pc - m1 qc log(m1) (ring_integrals.hpp): minimax coefficients.
template <class S>
struct RingFit {
    static constexpr bool available = false;
};

/// Maximal relative error 3.6e-17 in h and in c; values at m1 = 0 are exact (Remez exchange in 60 digits on the
/// Chebyshev system {x^i, x^j log x}; docs/free_space_kernel.md, section 4).
template <>
struct RingFit<double> {
    static constexpr bool available = true;
    static constexpr std::array<double, 12> ph{
        -0.61370563888010938117, -0.63083768744516650264, -0.6341213131928997904,  -0.63522459759874350072,
        -0.63428515300413524724, -0.60011841284419473866, -0.29084123255163079738, 0.76610199355979872101,
        1.8348474170495393956,   1.3177023506449687842,   0.30225484880698964801,  0.014576966304945479649};
    static constexpr std::array<double, 12> qh{0.5,
                                               1.1249999999963423866,
                                               1.7578124891329904025,
                                               2.3925741456666158743,
                                               3.0277364462678078126,
                                               3.6520693065368628543,
                                               4.1417557433483233725,
                                               3.9702257535422069527,
                                               2.5849251663611303125,
                                               0.87580814396381253315,
                                               0.11254583393027308252,
                                               0.0029845132600860937697};
    static constexpr std::array<double, 12> pc{1.0,
                                               0.67055845830827359854,
                                               0.64792207625645732163,
                                               0.64214073850505534399,
                                               0.63893610461230386755,
                                               0.61254264782662725979,
                                               0.35846974851515924685,
                                               -0.60102836767520152452,
                                               -1.7113081836082808198,
                                               -1.32874874825085617,
                                               -0.32396484137482969624,
                                               -0.01647101056662217579};
    static constexpr std::array<double, 11> qc{
        -0.74999999999880370524, -1.4062499952717689141,  -2.0507791280911802258,   -2.6914197754399506259,
        -3.3225055645998576643,  -3.8461250463366950729,  -3.7932831457348273866,   -2.5698274714403656763,
        -0.91155575392187071575, -0.12272106302070476691, -0.0034022323288066401308};
};

/// Maximal relative error 1.1e-9.
template <>
struct RingFit<float> {
    static constexpr bool available = true;
    static constexpr std::array<float, 7> ph{-0.61370563888F, -0.630773924304F, -0.621515944122F, -0.332972338493F,
                                             0.886152719067F, 1.27433208628F,   0.234832581085F};
    static constexpr std::array<float, 7> qh{0.5F,           1.12499134574F,  1.75502898278F,  2.28652551182F,
                                             2.07424078004F, 0.798557406919F, 0.0604621370373F};
    static constexpr std::array<float, 7> pc{
        1.0F, 0.670529520018F, 0.640197959235F, 0.415705839953F, -0.680390387407F, -1.20977110891F, -0.247223199788F};
    static constexpr std::array<float, 6> qc{-0.74999626464F, -1.40462932744F,  -1.9756100467F,
                                             -1.91763308377F, -0.795769136143F, -0.0648134187245F};
};

/// Horner's rule unrolled at compile time, so that a loop over x has a straight-line body to vectorise.
template <std::size_t I = 0, class S, std::size_t N>
constexpr S horner(const std::array<S, N>& coefficients, S x) noexcept {
    if constexpr (I + 1 == N) {
        return coefficients[I];
    } else {
        return coefficients[I] + x * horner<I + 1>(coefficients, x);
    }
}

}  // namespace axistokes::detail
