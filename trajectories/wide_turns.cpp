#include "trajectories/wide_turns.h"

#include <cmath>
#include <stdexcept>

#include "trajectories/orbit_search.h"

namespace domefall {
namespace {

// Roots that are as close to each other as this part of them may be complex, or not.
constexpr double kBlur = 1e-12;

// Returns p/(w - root), whose remainder is left out.
WidePolynomial divided(const WidePolynomial& p, const Wide& root) {
  WidePolynomial quotient(p.size() - 1);
  Wide sum = 0;
  for (std::size_t k = p.size() - 1; k > 0; --k) quotient[k - 1] = sum = p[k] + root * sum;
  return quotient;
}

ChargedTurns narrowed(const WideSpace& s, const WideConstants& c, const Wide& w1, const Wide& w2) {
  ChargedTurns t{};
  t.hole = s.hole;
  t.energy = static_cast<double>(sqrt(Wide(1 + c.excess)));
  t.l = static_cast<double>(sqrt(c.l2));
  t.near = static_cast<double>(1 / w2);
  t.far = w1 > 0 ? static_cast<double>(1 / w1) : kInfinity;
  t.width = w1 > 0 ? static_cast<double>(1 / w1 - 1 / w2) : kInfinity;
  t.w1 = static_cast<double>(w1);
  const Wide a = s.q2 * c.l2;
  t.a = static_cast<double>(a);
  t.others = ChargedTurns::Others::kComplex;
  // Without L the rest is q^2.
  t.lead = static_cast<double>(s.q2);
  if (a == 0) return t;
  const WidePolynomial rest = divided(divided(radial_polynomial(s, c), w1), w2);
  const Wide middle = -rest[1] / (2 * rest[2]), under = middle * middle - rest[0] / rest[2];
  const Wide apart = sqrt(abs(under));
  // A double root within the orbit may come out as two, and one at its end as one beside it.
  const Wide blur = abs(middle) * kBlur;
  const bool inside = middle > w2 - blur, beyond = middle < w1 + blur;
  if ((under < 0 || apart < blur) && !(apart < blur && (inside || beyond))) {
    const Wide least = middle * middle * kLeastExcess;
    t.middle = static_cast<double>(middle);
    t.lead = static_cast<double>(a * std::max(Wide(-under), least));
    return t;
  }
  const Wide low = middle - apart, high = middle + apart, least = w2 * kLeastExcess;
  const Wide gap = std::max(inside ? Wide(low - w2) : Wide(w1 - high), least);
  t.others = inside ? ChargedTurns::Others::kInside : ChargedTurns::Others::kBeyond;
  t.gap = static_cast<double>(gap);
  t.lead = static_cast<double>(a * std::max(inside ? Wide(high - w2) : Wide(w1 - low), gap));
  return t;
}

}  // namespace

Wide value(const WidePolynomial& p, const Wide& x) {
  Wide sum = 0;
  for (std::size_t k = p.size(); k > 0; --k) sum = sum * x + p[k - 1];
  return sum;
}

// Between two roots of its derivative a polynomial has one root at most.
std::vector<Wide> roots_of(WidePolynomial p) {
  while (p.size() > 1 && p.back() == 0) p.pop_back();
  std::vector<Wide> roots;
  if (p.size() > 1 && p.front() == 0) {
    roots = roots_of({p.begin() + 1, p.end()});
    roots.insert(std::upper_bound(roots.begin(), roots.end(), Wide(0)), Wide(0));
    return roots;
  }
  if (p.size() < 2) return roots;
  WidePolynomial slope;
  Wide largest = 0;
  for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(p[k] * static_cast<int>(k));
  for (const Wide& c : p) largest = std::max(largest, Wide(abs(c / p.back())));
  std::vector<Wide> ends = roots_of(slope);
  ends.insert(ends.begin(), -1 - largest);
  ends.push_back(1 + largest);
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const Wide low = value(p, ends[k - 1]), high = value(p, ends[k]);
    if (high == 0) roots.push_back(ends[k]);
    if ((low < 0 && high > 0) || (low > 0 && high < 0))
      roots.push_back(wide_zero([&p](const Wide& x) { return value(p, x); }, ends[k - 1], ends[k]));
  }
  return roots;
}

WidePolynomial radial_polynomial(const WideSpace& s, const WideConstants& c) {
  return {c.excess, 2, -(s.q2 + c.l2), 2 * c.l2, -s.q2 * c.l2};
}

WideTurns turns_between(const WideSpace& s, const WideConstants& c, const Wide& w1,
                        const Wide& w2) {
  return {narrowed(s, c, w1, w2), w1, w2};
}

Wide next_root(const WidePolynomial& p, const Wide& w, bool above) {
  const std::vector<Wide> roots = roots_of(p);
  const auto after = std::upper_bound(roots.begin(), roots.end(), w);
  if (above ? after == roots.end() : after == roots.begin())
    throw std::domain_error("r is where such an orbit cannot turn");
  return above ? *after : *(after - 1);
}

WideTurns turns_about(const WideSpace& s, const WideConstants& c, const Wide& w) {
  const WidePolynomial p = radial_polynomial(s, c);
  return turns_between(s, c, next_root(p, w, false), next_root(p, w, true));
}

WideTurns turns_from(const WideSpace& s, const WideConstants& c, const Wide& w) {
  const WidePolynomial p = radial_polynomial(s, c);
  const Wide inside = w * (1 + kRootBeside), outside = w * (1 - kRootBeside);
  if (value(p, inside) > 0) return turns_between(s, c, w, next_root(p, inside, true));
  if (value(p, outside) > 0) return turns_between(s, c, next_root(p, outside, false), w);
  return turns_between(s, c, w, w);
}

}  // namespace domefall
