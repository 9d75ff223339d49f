#include "pipeline/sources/stars/solar_system.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

constexpr double kObliquity = 23.43928 * kDegree;  // of the ecliptic, J2000
// Light takes 499.004784 s for an astronomical unit.
constexpr double kLightCenturiesPerAu = 499.004784 / 86400 / 36525;

struct Elements {
  double a;  // au
  double eccentricity;
  double inclination;  // this and what follows: degrees, to the ecliptic and equinox of J2000
  double longitude;    // mean longitude L
  double perihelion;   // longitude of perihelion
  double node;         // longitude of the ascending node
};

// The mean anomaly has b T^2 + c cos(f T) + s sin(f T) besides (degrees; T in centuries).
struct Wobble {
  double b, c, s, f;
};

struct Orbit {
  Elements at_2000, per_century;  // of Julian years
  Wobble wobble{};
};

// The orbits stand in the order of SolarBody, with that of the Earth in the place of the Sun.
constexpr std::size_t kEarth = 7;
using Orbits = std::array<Orbit, 8>;

// Standish's table 1, 1800 to 2050.
constexpr YearSpan kModern{1800, 2050};
constexpr Orbits kModernOrbits{{
    {{0.38709927, 0.20563593, 7.00497902, 252.25032350, 77.45779628, 48.33076593},
     {0.00000037, 0.00001906, -0.00594749, 149472.67411175, 0.16047689, -0.12534081}},
    {{0.72333566, 0.00677672, 3.39467605, 181.97909950, 131.60246718, 76.67984255},
     {0.00000390, -0.00004107, -0.00078890, 58517.81538729, 0.00268329, -0.27769418}},
    {{1.52371034, 0.09339410, 1.84969142, -4.55343205, -23.94362959, 49.55953891},
     {0.00001847, 0.00007882, -0.00813131, 19140.30268499, 0.44441088, -0.29257343}},
    {{5.20288700, 0.04838624, 1.30439695, 34.39644051, 14.72847983, 100.47390909},
     {-0.00011607, -0.00013253, -0.00183714, 3034.74612775, 0.21252668, 0.20469106}},
    {{9.53667594, 0.05386179, 2.48599187, 49.95424423, 92.59887831, 113.66242448},
     {-0.00125060, -0.00050991, 0.00193609, 1222.49362201, -0.41897216, -0.28867794}},
    {{19.18916464, 0.04725744, 0.77263783, 313.23810451, 170.95427630, 74.01692503},
     {-0.00196176, -0.00004397, -0.00242939, 428.48202785, 0.40805281, 0.04240589}},
    {{30.06992276, 0.00859048, 1.77004347, -55.12002969, 44.96476227, 131.78422574},
     {0.00026291, 0.00005105, 0.00035372, 218.45945325, -0.32241464, -0.00508664}},
    {{1.00000261, 0.01671123, -0.00001531, 100.46457166, 102.93768193, 0},
     {0.00000562, -0.00004392, -0.01294668, 35999.37244981, 0.32327364, 0}},
}};

// Standish's tables 2a and 2b, 3000 BC to AD 3000.
constexpr YearSpan kKnown{-2999, 3000};
constexpr Orbits kLongOrbits{{
    {{0.38709843, 0.20563661, 7.00559432, 252.25166724, 77.45771895, 48.33961819},
     {0.00000000, 0.00002123, -0.00590158, 149472.67486623, 0.15940013, -0.12214182}},
    {{0.72332102, 0.00676399, 3.39777545, 181.97970850, 131.76755713, 76.67261496},
     {-0.00000026, -0.00005107, 0.00043494, 58517.81560260, 0.05679648, -0.27274174}},
    {{1.52371243, 0.09336511, 1.85181869, -4.56813164, -23.91744784, 49.71320984},
     {0.00000097, 0.00009149, -0.00724757, 19140.29934243, 0.45223625, -0.26852431}},
    {{5.20248019, 0.04853590, 1.29861416, 34.33479152, 14.27495244, 100.29282654},
     {-0.00002864, 0.00018026, -0.00322699, 3034.90371757, 0.18199196, 0.13024619},
     {-0.00012452, 0.06064060, -0.35635438, 38.35125000}},
    {{9.54149883, 0.05550825, 2.49424102, 50.07571329, 92.86136063, 113.63998702},
     {-0.00003065, -0.00032044, 0.00451969, 1222.11494724, 0.54179478, -0.25015002},
     {0.00025899, -0.13434469, 0.87320147, 38.35125000}},
    {{19.18797948, 0.04685740, 0.77298127, 314.20276625, 172.43404441, 73.96250215},
     {-0.00020455, -0.00001550, -0.00180155, 428.49512595, 0.09266985, 0.05739699},
     {0.00058331, -0.97731848, 0.17689245, 7.67025000}},
    {{30.06952752, 0.00895439, 1.77005520, 304.22289287, 46.68158724, 131.78635853},
     {0.00006447, 0.00000818, 0.00022400, 218.46515314, 0.01009938, -0.00606302},
     {-0.00041348, 0.68346318, -0.10162547, 7.67025000}},
    {{1.00000018, 0.01673163, -0.00054346, 100.46691572, 102.93005885, -5.11260389},
     {-0.00000003, -0.00003661, -0.01337178, 35999.37306329, 0.31795260, -0.24123856}},
}};

V3d from_ecliptic(const V3d& v) {
  const double c = std::cos(kObliquity), s = std::sin(kObliquity);
  return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

// Solves Kepler's equation M = E - e sin E.  Newton's steps double the digits, and e is below 0.21.
double eccentric_anomaly(double m, double e) {
  double anomaly = m + e * std::sin(m);
  for (int step = 0; step < 5; ++step)
    anomaly -= (anomaly - e * std::sin(anomaly) - m) / (1 - e * std::cos(anomaly));
  return anomaly;
}

// Returns the place on an orbit T centuries after 2000, in au from the Sun, by J2000's equator.
V3d place_on(const Orbit& orbit, double t) {
  const Elements &o = orbit.at_2000, &rate = orbit.per_century;
  const Wobble& w = orbit.wobble;
  const double a = o.a + rate.a * t, e = o.eccentricity + rate.eccentricity * t;
  const double inclination = (o.inclination + rate.inclination * t) * kDegree;
  const double perihelion = o.perihelion + rate.perihelion * t;
  const double node = (o.node + rate.node * t) * kDegree;
  const double mean = o.longitude + rate.longitude * t - perihelion + w.b * t * t +
                      w.c * std::cos(w.f * t * kDegree) + w.s * std::sin(w.f * t * kDegree);
  const double anomaly = eccentric_anomaly(std::remainder(mean, 360) * kDegree, e);
  // In the plane of the orbit, x points to the perihelion, and u to the node.
  const double x = a * (std::cos(anomaly) - e), y = a * std::sqrt(1 - e * e) * std::sin(anomaly);
  const double from_node = perihelion * kDegree - node;
  const double u = std::cos(from_node) * x - std::sin(from_node) * y;
  const double v = std::sin(from_node) * x + std::cos(from_node) * y;
  const double along = v * std::cos(inclination);
  return from_ecliptic({std::cos(node) * u - std::sin(node) * along,
                        std::sin(node) * u + std::cos(node) * along, v * std::sin(inclination)});
}

double centuries(double year) { return (year - 2000) / 100; }

// Sight is a planet as it is seen from the Earth: its places from the Sun and from the Earth, in
// au, when the light left that is seen now.
struct Sight {
  V3d from_sun, from_earth;
};

Sight sight_of(SolarBody planet, double year) {
  const Orbits& orbits =
      year >= kModern.first && year <= kModern.last ? kModernOrbits : kLongOrbits;
  const double t = centuries(year);
  const V3d earth = place_on(orbits[kEarth], t);
  if (planet == SolarBody::kSun) return {V3d(0), -earth};
  const Orbit& orbit = orbits[static_cast<std::size_t>(planet)];
  const double distance = (place_on(orbit, t) - earth).length();
  const V3d place = place_on(orbit, t - distance * kLightCenturiesPerAu);
  return {place, place - earth};
}

// A term of the Moon's motion: an amplitude (1e-6 degrees) of the sine of multiples of D, M, M' and
// F (Meeus, table 47).
struct MoonTerm {
  int d, m, m_moon, f;
  double amplitude;
};

constexpr MoonTerm kMoonLongitude[]{
    {0, 0, 1, 0, 6288774}, {2, 0, -1, 0, 1274027}, {2, 0, 0, 0, 658314},  {0, 0, 2, 0, 213618},
    {0, 1, 0, 0, -185116}, {0, 0, 0, 2, -114332},  {2, 0, -2, 0, 58793},  {2, -1, -1, 0, 57066},
    {2, 0, 1, 0, 53322},   {2, -1, 0, 0, 45758},   {0, 1, -1, 0, -40923}, {1, 0, 0, 0, -34720},
    {0, 1, 1, 0, -30383},  {2, 0, 0, -2, 15327},   {0, 0, 1, 2, -12528},  {0, 0, 1, -2, 10980},
    {4, 0, -1, 0, 10675},  {0, 0, 3, 0, 10034}};
constexpr MoonTerm kMoonLatitude[]{
    {0, 0, 0, 1, 5128122}, {0, 0, 1, 1, 280602},  {0, 0, 1, -1, 277693}, {2, 0, 0, -1, 173237},
    {2, 0, -1, 1, 55413},  {2, 0, -1, -1, 46271}, {2, 0, 0, 1, 32573},   {0, 0, 2, 1, 17198},
    {2, 0, 1, -1, 9266},   {0, 0, 2, -1, 8822},   {2, -1, 0, -1, 8216}};

// Takes the ecliptic of the year for that of J2000, which is 0.03 degrees away in 1800.
SkyDirection moon_at(double t) {
  const double d = 297.8501921 + t * (445267.1114034 - 0.0018819 * t);
  const double m = 357.5291092 + t * (35999.0502909 - 0.0001536 * t);
  const double m_moon = 134.9633964 + t * (477198.8675055 + 0.0087414 * t);
  const double f = 93.2720950 + t * (483202.0175233 - 0.0036539 * t);
  const auto sum = [&](std::span<const MoonTerm> terms) {
    double degrees = 0;
    for (const MoonTerm& k : terms)
      degrees += 1e-6 * k.amplitude *
                 std::sin((k.d * d + k.m * m + k.m_moon * m_moon + k.f * f) * kDegree);
    return degrees;
  };
  // The mean longitude counts from the equinox of the year, which moves by the precession.
  const double mean = 218.3164477 + t * (481267.88123421 - 0.0015786 * t);
  const double precession = t * (1.3969713 + 0.0003086 * t);
  const double longitude = (mean - precession + sum(kMoonLongitude)) * kDegree;
  const double latitude = sum(kMoonLatitude) * kDegree;
  return {from_ecliptic({std::cos(latitude) * std::cos(longitude),
                         std::cos(latitude) * std::sin(longitude), std::sin(latitude)})};
}

// Returns what the rings add to the magnitude of Saturn, whose north pole is at RA 40.589, Dec
// 83.537 (IAU).  `i` is the phase angle in degrees, for the difference of the Saturnicentric
// longitudes of Sun and Earth.
double rings_of_saturn(const V3d& from_earth, double i) {
  const double tilt = std::abs(sky_direction(40.589, 83.537).v.dot(from_earth.normalized()));
  return 0.044 * i + tilt * (-2.60 + 1.25 * tilt);
}

// Returns V of a planet at 1 au from Sun and Earth, at a phase angle of `i` degrees.
double magnitude_at_phase(SolarBody planet, const V3d& from_earth, double i) {
  switch (planet) {
    case SolarBody::kMercury:
      return -0.42 + i * (0.0380 + i * (-0.000273 + i * 0.000002));
    case SolarBody::kVenus:
      return -4.40 + i * (0.0009 + i * (0.000239 - i * 0.00000065));
    case SolarBody::kMars:
      return -1.52 + 0.016 * i;
    case SolarBody::kJupiter:
      return -9.40 + 0.005 * i;
    case SolarBody::kSaturn:
      return -8.88 + rings_of_saturn(from_earth, i);
    case SolarBody::kUranus:
      return -7.19;
    default:
      return -6.87;  // Neptune
  }
}

constexpr double kPlanetColours[kPlanets]{0.93, 0.82, 1.36, 0.83, 1.04, 0.56, 0.41};  // B-V

}  // namespace

std::optional<SolarBody> solar_body(std::string_view name) {
  const std::string folded = folded_star_name(name);
  for (std::size_t k = 0; k < kSolarBodyNames.size(); ++k)
    if (folded == folded_star_name(kSolarBodyNames[k])) return static_cast<SolarBody>(k);
  return std::nullopt;
}

YearSpan years_of(SolarBody body) { return body == SolarBody::kMoon ? kModern : kKnown; }

SkyDirection seen_from_earth(SolarBody body, double year) {
  if (body == SolarBody::kMoon) return moon_at(centuries(year));
  return {sight_of(body, year).from_earth.normalized()};
}

double planet_magnitude(SolarBody planet, double year) {
  const Sight sight = sight_of(planet, year);
  const double from_sun = sight.from_sun.length(), from_earth = sight.from_earth.length();
  const double cosine = sight.from_sun.dot(sight.from_earth) / (from_sun * from_earth);
  const double i = std::acos(std::clamp(cosine, -1.0, 1.0)) / kDegree;
  return 5 * std::log10(from_sun * from_earth) + magnitude_at_phase(planet, sight.from_earth, i);
}

StarCatalogue planets_as_stars(double year) {
  StarCatalogue planets;
  for (std::size_t k = 0; k < kPlanets; ++k) {
    const auto planet = static_cast<SolarBody>(k);
    const SkyDirection direction = seen_from_earth(planet, year);
    planets.stars.push_back({direction, static_cast<float>(planet_magnitude(planet, year)),
                             static_cast<float>(temperature_from_b_v(kPlanetColours[k]))});
    planets.names.push_back({std::string(kSolarBodyNames[k]), direction});
  }
  sort_by_magnitude(planets.stars);
  return planets;
}

}  // namespace domefall
