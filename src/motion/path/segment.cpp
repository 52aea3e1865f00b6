#include "passo/path/segment.hpp"

namespace passo {
namespace {

Point less(Point point, Axis axis, double by) {
  point[axis] -= by;
  return point;
}

}  // namespace

double MotorLead::at(double s, double length) const {
  const double t = s / length;
  const double u = 1 - t;
  return u * u * ((1 + 2 * t) * start + t * length * start_slope) +
         t * t * ((1 + 2 * u) * end - u * length * end_slope);
}

double MotorLead::slope_at(double s, double length) const {
  const double t = s / length;
  const double u = 1 - t;
  return 6 * t * u * (end - start) / length + u * (u - 2 * t) * start_slope + t * (t - 2 * u) * end_slope;
}

MotorLead MotorLead::part(double from, double to, double length) const {
  return {.axis = axis,
          .start = from > 0 ? at(from, length) : start,
          .start_slope = from > 0 ? slope_at(from, length) : start_slope,
          .end = to < length ? at(to, length) : end,
          .end_slope = to < length ? slope_at(to, length) : end_slope};
}

Point Segment::tool_at(Mm s) const {
  if (takes_up_backlash) return curve.end();
  return lead ? less(curve.at(s), lead->axis, lead->at(s.value(), curve.length().value())) : curve.at(s);
}

Curve Segment::tool_curve() const {
  if (!lead) return curve;
  const Axis axis = lead->axis;
  return Curve::cubic(less(curve.start(), axis, lead->start), less(curve.tangent(Mm(0)), axis, lead->start_slope),
                      less(curve.end(), axis, lead->end), less(curve.tangent(curve.length()), axis, lead->end_slope),
                      curve.length());
}

void Segment::drop_before(Mm s) {
  const Mm length = curve.length();
  if (lead) lead = lead->part(s.value(), length.value(), length.value());
  curve = curve.part(s, length);
}

}  // namespace passo
