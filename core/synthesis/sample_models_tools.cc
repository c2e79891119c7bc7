#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/synthesis/pose.h"
#include "core/synthesis/sample_models.h"
#include "core/synthesis/sweep.h"

namespace argmesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d Along(const Pose& pose, double x, double y, double z) {
  return pose * Vector3d(x, y, z);
}

// One of the two levers: jaw toward +x, handle bowing out toward -x. `side`
// is +1 when the jaw lies above the axis; the handle then lies below.
void AddLever(ImplicitSurface& surface, const Pose& pose, double side,
              double handle_length) {
  surface.BeginPart("jaws");
  const Outline jaw = {{-0.05, side * -0.05}, {0.05, side * 0.015},
                       {0.32, side * 0.012},  {0.33, side * 0.035},
                       {0.16, side * 0.1},    {-0.02, side * 0.08}};
  surface.Add(MakeExtrusion(pose, jaw, 0.02, 0.012), 0.02);
  surface.BeginPart("handles");
  const double l = handle_length;
  const std::vector<SweepKnot> knots = {
      {Along(pose, 0, 0, 0), 0.045},
      {Along(pose, -0.12, side * -0.075, 0), 0.038},
      {Along(pose, -0.45 * l, side * -0.15, 0), 0.042},
      {Along(pose, -l, side * -0.11, 0), 0.036}};
  AddSweep(surface, knots, {.blend = 0.012, .pieces = 5});
}

void AddJaw(ImplicitSurface& surface, const Pose& pose, double size) {
  surface.BeginPart("jaw");
  surface.Add(MakeExtrusion(pose, CircleOutline({0, 0}, size, 32), 0.022, 0.01),
              0.03);
  const double gap = 0.42 * size;
  surface.Cut(
      MakeBox(pose * At(0.85 * size, 0, 0), {0.85 * size, gap, 0.2}, 0.004),
      0.025);
}

void AddRing(ImplicitSurface& surface, const Pose& pose, double size) {
  surface.BeginPart("ring");
  surface.Add(MakeExtrusion(pose, CircleOutline({0, 0}, size, 32), 0.024, 0.01),
              0.03);
  surface.Cut(
      MakeExtrusion(pose, CircleOutline({0, 0}, 0.58 * size, 6), 0.2, 0.0));
}

}  // namespace

SampleModel MakePliers(Random& random) {
  const double opening = random.Uniform(7, 30);
  const double length = random.Uniform(0.52, 0.85);
  SampleModel model;
  AddLever(model.surface, TurnZ(opening), 1, length);
  AddLever(model.surface, TurnZ(-opening), -1, length);
  model.surface.BeginPart("pivot");
  model.surface.Add(
      MakeLathe(Pose::Identity(), RectangleOutline({0, -0.045}, {0.075, 0.045}),
                0.01),
      0.01);
  return model;
}

SampleModel MakeWrench(Random& random) {
  const double half = random.Uniform(0.38, 0.52);
  const double size = random.Uniform(0.1, 0.15);
  const bool ring = random.Below(2) == 0;
  SampleModel model{.surface = {}, .genus = ring ? 1 : 0};
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("handle");
  surface.Add(MakeBox(Pose::Identity(),
                      {half, random.Uniform(0.022, 0.032), 0.012}, 0.014));
  const double tilt = random.Uniform(10, 20);
  AddJaw(surface, At(half, 0, 0) * TurnZ(tilt), size);
  if (ring) {
    AddRing(surface, At(-half, 0, 0), 0.85 * size);
  } else {
    AddJaw(surface, At(-half, 0, 0) * TurnZ(180 + tilt), 0.85 * size);
  }
  return model;
}

SampleModel MakeKey(Random& random) {
  const double length = random.Uniform(0.5, 0.8);
  const double bow = random.Uniform(0.12, 0.2);
  const double shaft = random.Uniform(0.03, 0.038);
  SampleModel model{.surface = {}, .genus = 1};
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("bow");
  surface.Add(MakeTorus(At(-bow, 0, 0), bow, random.Uniform(0.036, 0.055)));
  surface.BeginPart("shaft");
  surface.Add(MakeCapsule({0, 0, 0}, {length, 0, 0}, shaft, shaft), 0.02);
  surface.Add(MakeTorus(At(0.07, 0, 0) * TurnY(90), shaft, 0.022), 0.01);
  surface.BeginPart("bit");
  const int teeth = 2 + static_cast<int>(random.Below(3));
  for (int i = 0; i < teeth; ++i) {
    const double depth = random.Uniform(0.055, 0.09);
    const double x = length - 0.03 - 0.07 * i;
    surface.Add(MakeBox(At(x, -depth - 0.02, 0), {0.016, depth, 0.01}, 0.008),
                0.008);
  }
  return model;
}

SampleModel MakeGear(Random& random) {
  const int teeth = 10 + static_cast<int>(random.Below(9));
  const double root = random.Uniform(0.36, 0.4);
  const double thick = random.Uniform(0.06, 0.1);
  const int holes = static_cast<int>(random.Below(3)) * 2;
  SampleModel model{.surface = {}, .genus = 1 + holes};
  Outline outline;
  const double pitch = 2 * std::numbers::pi / teeth;
  for (int i = 0; i < teeth; ++i) {
    // Root, flank up, tip, flank down, as shares of the pitch.
    const std::array<std::array<double, 2>, 4> corners = {
        {{0.0, root}, {0.42, root}, {0.55, 0.5}, {0.87, 0.5}}};
    for (const auto& [share, radius] : corners) {
      const double angle = (i + share) * pitch;
      outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("teeth");
  surface.Add(MakeExtrusion(Pose::Identity(), outline, thick, 0.01));
  surface.BeginPart("hub");
  surface.Add(
      MakeLathe(Pose::Identity(),
                RectangleOutline({0, -thick - 0.05}, {0.15, thick + 0.05}),
                0.01),
      0.02);
  surface.Cut(
      MakeLathe(Pose::Identity(), RectangleOutline({0, -1}, {0.08, 1}), 0));
  for (int i = 0; i < holes; ++i) {
    const Pose at = TurnZ(360.0 * i / holes) * At(0.25, 0, 0);
    surface.Cut(MakeLathe(at, RectangleOutline({0, -1}, {0.055, 1}), 0));
  }
  return model;
}

namespace {

// A closed wire about (center, 0, 0); `square` above 1 pushes it outward
// between the axes.
void AddRim(ImplicitSurface& surface, double center,
            const Eigen::Vector2d& radii, double square, double wire) {
  std::vector<SweepKnot> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = std::numbers::pi / 6 * i;
    const double corner = 1 + (square - 1) * std::pow(std::sin(2 * angle), 2.0);
    rim.push_back({{center + radii.x() * corner * std::cos(angle), 0,
                    radii.y() * corner * std::sin(angle)},
                   wire});
  }
  surface.BeginPart("rims");
  AddSweep(surface, rim, {.blend = 0, .pieces = 3, .closed = true});
}

void AddTemple(ImplicitSurface& surface, const Pose& hinge, double wire) {
  const std::vector<SweepKnot> temple = {
      {Along(hinge, 0, -0.01, 0), wire},
      {Along(hinge, 0, 0.25, 0.01), 0.9 * wire},
      {Along(hinge, 0, 0.56, 0), 0.9 * wire},
      {Along(hinge, 0, 0.72, -0.12), wire}};
  surface.BeginPart("temples");
  AddSweep(surface, temple, {.blend = 0.012, .pieces = 5});
}

}  // namespace

SampleModel MakeGlasses(Random& random) {
  const double width = random.Uniform(0.2, 0.23);
  const double height = random.Uniform(0.72, 1.0) * width;
  const double square = random.Uniform(1.0, 1.12);
  const double wire = random.Uniform(0.016, 0.022);
  const double bridge = random.Uniform(0.05, 0.07);
  SampleModel model{.surface = {}, .genus = 2};
  ImplicitSurface& surface = model.surface;
  for (const double side : {-1.0, 1.0}) {
    AddRim(surface, side * (width + bridge), {width, height}, square, wire);
    const double reach = 2 * width + bridge + 0.015;
    const double fold = random.Uniform(0, 55);
    AddTemple(surface,
              At(side * reach, 0.01, 0.3 * height) * TurnZ(side * fold), wire);
  }
  surface.BeginPart("bridge");
  const double at = 0.25 * height;
  const std::vector<SweepKnot> arch = {{{-bridge - 0.01, 0, at}, wire},
                                       {{0, -0.01, at + 0.04}, wire},
                                       {{bridge + 0.01, 0, at}, wire}};
  AddSweep(surface, arch, {.blend = 0.012, .pieces = 5});
  return model;
}

namespace {

void AddWings(ImplicitSurface& surface, double span, double sweep,
              double chord) {
  for (const double side : {-1.0, 1.0}) {
    surface.BeginPart("wings");
    const Pose root = At(0, -0.02, -0.03) * TurnY(side * -5);
    const Outline wing = {{0, -0.5 * chord},
                          {side * span, sweep - 0.02},
                          {side * span, sweep + 0.06},
                          {0, 0.55 * chord}};
    surface.Add(MakeExtrusion(root, wing, 0.001, 0.014), 0.02);
    surface.BeginPart("tail");
    const Outline stabilizer = {
        {0, -0.06}, {side * 0.19, 0.05}, {side * 0.19, 0.1}, {0, 0.07}};
    surface.Add(MakeExtrusion(At(0, 0.44, 0.03), stabilizer, 0.001, 0.011),
                0.01);
  }
}

}  // namespace

SampleModel MakeAirplane(Random& random) {
  const double body = random.Uniform(0.06, 0.075);
  const double sweep = random.Uniform(0.0, 0.32);
  const double span = random.Uniform(0.42, 0.66);
  const double engine_at = random.Uniform(0.35, 0.5);
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("fuselage");
  const std::vector<SweepKnot> fuselage = {{{0, -0.52, -0.015}, 0.3 * body},
                                           {{0, -0.42, 0}, body},
                                           {{0, 0, 0}, body},
                                           {{0, 0.25, 0.005}, body},
                                           {{0, 0.55, 0.04}, 0.25 * body}};
  AddSweep(surface, fuselage, {.blend = 0.01, .pieces = 4});
  AddWings(surface, span, sweep, random.Uniform(0.2, 0.26));
  surface.BeginPart("tail");
  const Outline fin = {{0.36, 0.02}, {0.52, 0.2}, {0.58, 0.2}, {0.54, 0.02}};
  Pose upright = Pose::Identity();
  upright.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  surface.Add(MakeExtrusion(upright, fin, 0.001, 0.011), 0.01);
  surface.BeginPart("engines");
  const int engines = 1 + static_cast<int>(random.Below(2));
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < engines; ++i) {
      const double share = engine_at + (i == 0 ? -0.08 : 0.22);
      const double x = side * span * share;
      const double y = sweep * share - 0.1 + 0.04 * i;
      const double z = -0.065 + 0.09 * span * share;
      surface.Add(MakeCapsule({x, y - 0.06, z}, {x, y + 0.05, z}, 0.034, 0.026),
                  0.01);
    }
  }
  return model;
}

}  // namespace argmesh
