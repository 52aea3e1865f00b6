// sin(), cos(), atan2(), acos(), asin() and hypot() for WebAssembly, correctly rounded in nearly every case.
//
// The C library of WASI rounds 3 % of the sines and 18 % of the arc tangents differently from glibc, which is correctly
// rounded in more than 99.8 % of the cases. A difference in the last bit can tip a decision of the path smoother, and
// then a browser would show another time than the program in the fifth digit. These functions take the place of the
// library's: they compute with two doubles (about 100 bits) and round once.
//
// Method: T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971).
#include <cmath>
#include <initializer_list>

namespace {

struct Twice {  // high + low, |low| <= half a unit in the last place of high
  double high;
  double low;
};

constexpr Twice quick_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
constexpr Twice sum_of(double a, double b) {
  const double sum = a + b;
  const double from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}
constexpr Twice product_of(double a, double b) {
  constexpr double splitter = 134'217'729;  // 2^27 + 1
  const double a_wide = splitter * a;
  const double a_high = a_wide - (a_wide - a);
  const double a_low = a - a_high;
  const double b_wide = splitter * b;
  const double b_high = b_wide - (b_wide - b);
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}
constexpr Twice operator+(Twice a, Twice b) {
  const Twice high = sum_of(a.high, b.high);
  const Twice low = sum_of(a.low, b.low);
  const Twice sum = quick_sum(high.high, high.low + low.high);
  return quick_sum(sum.high, sum.low + low.low);
}
constexpr Twice operator-(Twice a) {
  return {-a.high, -a.low};
}
constexpr Twice operator*(Twice a, Twice b) {
  const Twice product = product_of(a.high, b.high);
  return quick_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
constexpr Twice single(double a) {
  return {a, 0};
}
// 1 / n
constexpr Twice inverse(double n) {
  const double high = 1 / n;
  const Twice product = product_of(high, n);
  return {high, ((1 - product.high) - product.low) / n};
}

constexpr Twice pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Twice half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double largest_angle = 1e5;

// Of |r| <= pi/4, by Taylor's series. The terms that count less than 1e-6 need no second double.
Twice sine_of(Twice r) {
  const Twice z = r * r;
  const double x = z.high;
  const double tail =
      1 / 362'880.0 - x * (1 / 39'916'800.0 -
                           x * (1 / 6'227'020'800.0 - x * (1 / 1'307'674'368'000.0 -
                                                           x * (1 / 355'687'428'096'000.0 - x / 1.21645100408832e17))));
  const Twice sum = -inverse(6) + z * (inverse(120) + z * (-inverse(5040) + z * single(tail)));
  return r + r * z * sum;
}
Twice cosine_of(Twice r) {
  const Twice z = r * r;
  const double x = z.high;
  const double tail =
      -1 / 3'628'800.0 + x * (1 / 479'001'600.0 -
                              x * (1 / 87'178'291'200.0 - x * (1 / 20'922'789'888'000.0 -
                                                               x * (1 / 6.402373705728e15 - x / 2.43290200817664e18))));
  const Twice sum = single(-0.5) + z * (inverse(24) + z * (-inverse(720) + z * (inverse(40'320) + z * single(tail))));
  return single(1) + z * sum;
}

struct Reduced {
  Twice rest;  // |rest| <= pi/4
  int quarter = 0;
};
// |x| < largest_angle. Pi/2 in parts of 33 bits, whose multiples are exact.
Reduced reduce(double x) {
  const double turns = std::nearbyint(x / half_pi.high);
  Twice rest = sum_of(x, -turns * 1.57079632673412561417e+00);
  for (const double part : {6.07710050630396597660e-11, 2.02226624871116645580e-21, 8.47842766036889956997e-32}) {
    rest = rest + single(-turns * part);
  }
  return {rest, static_cast<int>(turns) & 3};
}
Twice sine_of_quarter(const Reduced& angle, int more) {
  const int quarter = (angle.quarter + more) & 3;
  const Twice value = (quarter & 1) != 0 ? cosine_of(angle.rest) : sine_of(angle.rest);
  return quarter >= 2 ? -value : value;
}

// For what is left to the library. Volatile: the compiler must not make sin(x) of (double)sinl(x), which is the
// function that it compiles.
long double wide(double x) {
  volatile long double wider = x;
  return wider;
}

// Neither too small nor too large for the products.
bool is_usual(double x) {
  return std::abs(x) > 1e-100 && std::abs(x) < 1e100;
}

}  // namespace

extern "C" {

double sin(double x) {
  if (x == 0) return x;
  if (!(std::abs(x) < largest_angle)) return static_cast<double>(sinl(wide(x)));
  return sine_of_quarter(reduce(x), 0).high;
}

double cos(double x) {
  if (!(std::abs(x) < largest_angle)) return static_cast<double>(cosl(wide(x)));
  return sine_of_quarter(reduce(x), 1).high;
}

double hypot(double x, double y) {
  if (!is_usual(x) || !is_usual(y)) {
    if (x == 0 || y == 0) return std::abs(x) + std::abs(y);
    return static_cast<double>(hypotl(wide(x), wide(y)));
  }
  const Twice square = product_of(x, x) + product_of(y, y);
  const double root = std::sqrt(square.high);
  const Twice off = square + -product_of(root, root);
  return root + off.high / (2 * root);
}

// One step of Newton's method from an angle that is right to a few bits.
double atan2(double y, double x) {
  const double up = std::abs(y);
  const double along = std::abs(x);
  if (!is_usual(up) || !is_usual(along) || !is_usual(up / along)) {
    return static_cast<double>(atan2l(wide(y), wide(x)));
  }
  const double first = up <= along ? std::atan(up / along) : half_pi.high - std::atan(along / up);
  const Reduced reduced = reduce(first);
  const Twice sine = sine_of_quarter(reduced, 0);
  const Twice cosine = sine_of_quarter(reduced, 1);
  const Twice off = single(up) * cosine + -(single(along) * sine);
  Twice angle = quick_sum(first, off.high / (along * cosine.high + up * sine.high));
  if (x < 0) angle = pi + -angle;
  return y < 0 ? -angle.high : angle.high;
}

double acos(double x) {
  if (!(std::abs(x) < 1)) return static_cast<double>(acosl(wide(x)));
  const double first = 2 * std::atan(std::sqrt((1 - x) / (1 + x)));
  const Reduced reduced = reduce(first);
  const Twice off = sine_of_quarter(reduced, 1) + single(-x);
  return quick_sum(first, off.high / sine_of_quarter(reduced, 0).high).high;
}

double asin(double x) {
  if (!(std::abs(x) < 1) || x == 0) return static_cast<double>(asinl(wide(x)));
  const double first = std::atan(x / std::sqrt((1 - x) * (1 + x)));
  const Reduced reduced = reduce(first);
  const Twice off = single(x) + -sine_of_quarter(reduced, 0);
  return quick_sum(first, off.high / sine_of_quarter(reduced, 1).high).high;
}
}
