#include "fusion/uwb/common_reference.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace locus::uwb {
namespace {

/// 64 pairs that hang together name 65 anchors; the reference itself is not an unknown.
constexpr int max_unknowns = static_cast<int>(max_observations);
using Laplacian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, max_unknowns, max_unknowns>;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, max_unknowns, 1>;

bool is_star(const Epoch& epoch) {
    return static_cast<int>(epoch.rows.size()) == epoch.anchor_count() - 1 &&
           std::all_of(epoch.rows.begin(), epoch.rows.end(),
                       [&](const Row& row) { return row.a == epoch.rows[0].a && row.b != row.a; });
}

/// Anchor 1 is the first row's a and the reference; no_anchor is 0; so unknown i is anchor i + 2.
void add_pair(Laplacian& laplacian, Unknowns& right_side, const Row& row) {
    const double weight = row.inverse_sigma * row.inverse_sigma;
    const int a = row.a - 2, b = row.b - 2;
    if (a >= 0) {
        laplacian(a, a) += weight;
        right_side(a) -= weight * row.value_m;
    }
    if (b >= 0) {
        laplacian(b, b) += weight;
        right_side(b) += weight * row.value_m;
    }
    if (a >= 0 && b >= 0) laplacian(std::max(a, b), std::min(a, b)) -= weight; // Cholesky reads the lower half
}

void solve_graph(const Epoch& epoch, CommonReference& reference) {
    const int unknowns = epoch.anchor_count() - 1;
    if (unknowns > max_unknowns) return;
    Laplacian laplacian = Laplacian::Zero(unknowns, unknowns);
    Unknowns right_side = Unknowns::Zero(unknowns);
    for (const Row& row : epoch.rows)
        if (row.a != row.b) add_pair(laplacian, right_side, row);
    const Eigen::LLT<Laplacian> cholesky(laplacian);
    const auto pivots = cholesky.matrixLLT().diagonal();
    reference.connected = cholesky.info() == Eigen::Success && pivots.minCoeff() > 1e-6 * pivots.maxCoeff();
    if (reference.connected) reference.difference_m.tail(unknowns) = cholesky.solve(right_side);
}

} // namespace

CommonReference common_reference(const Epoch& epoch) noexcept {
    CommonReference reference;
    reference.anchor = epoch.rows[0].a;
    reference.difference_m.setZero(epoch.anchors_m.cols());
    if (is_star(epoch)) {
        for (const Row& row : epoch.rows) reference.difference_m(row.b) = row.value_m;
        reference.connected = true;
    } else {
        solve_graph(epoch, reference);
    }
    return reference;
}

} // namespace locus::uwb
