#include <array>
#include <cmath>
#include <vector>

#include "core/synthesis/pose.h"
#include "core/synthesis/sample_models.h"
#include "core/synthesis/sweep.h"

namespace argmesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A loop in the xz plane from `top` to `bottom` bulging out to x = reach.
void AddHandle(ImplicitSurface& surface, const Vector2d& top,
               const Vector2d& bottom, double reach, double radius) {
  const double high = top.y();
  const double low = bottom.y();
  const double drop = high - low;
  const std::vector<SweepKnot> knots = {
      {{top.x(), 0, high}, radius},
      {{0.45 * top.x() + 0.55 * reach, 0, high + 0.04 * drop}, radius},
      {{reach, 0, high - 0.3 * drop}, radius},
      {{0.12 * bottom.x() + 0.88 * reach, 0, low + 0.3 * drop}, radius},
      {{bottom.x(), 0, low}, 0.9 * radius}};
  AddSweep(surface, knots, {.blend = 0.6 * radius, .pieces = 5});
}

struct ChairBack {
  double half_width = 0;
  double height = 0;
  double lean = 0;  // of the top behind the seat
  double post = 0;  // radius
  int rails = 1;    // the topmost is the widest
};

// Two posts and rails between them; `seat` is the middle of the rear edge.
void AddChairBack(ImplicitSurface& surface, const Vector3d& seat,
                  const ChairBack& back) {
  surface.BeginPart("back");
  for (const double x : {-back.half_width, back.half_width}) {
    surface.Add(MakeCapsule(seat + Vector3d(x, 0, 0),
                            seat + Vector3d(x, back.lean, back.height),
                            back.post, 0.9 * back.post),
                0.01);
  }
  const double tilt =
      -std::atan2(back.lean, back.height) * 180 / std::numbers::pi;
  for (int i = 0; i < back.rails; ++i) {
    const double half = i == 0 ? 0.035 : 0.02;
    const double at = back.height * (1.0 - 0.75 * i / back.rails) - half;
    const Vector3d middle =
        seat + Vector3d(0, back.lean * at / back.height, at);
    surface.Add(MakeBox(At(middle) * TurnX(tilt),
                        {back.half_width - 0.005, 0.004, half}, 0.012),
                0.006);
  }
}

}  // namespace

SampleModel MakeMug(Random& random) {
  const double radius = random.Uniform(0.32, 0.42);
  const double height = random.Uniform(0.8, 1.1);
  const double flare = random.Uniform(-0.04, 0.08);
  const double belly = random.Uniform(-0.02, 0.05);
  const Outline side =
      SmoothCurve({{radius, 0.02},
                   {radius + belly + 0.4 * flare, 0.4 * height},
                   {radius + flare, height}},
                  6, false);
  Outline curve = {{0, 0}, {radius - 0.06, 0}, {radius - 0.02, 0.005}};
  curve.insert(curve.end(), side.begin(), side.end());
  SampleModel model{.surface = {}, .genus = 1};
  model.surface.BeginPart("cup");
  model.surface.Add(MakeShell(Pose::Identity(), curve, 0.072));
  model.surface.BeginPart("handle");
  const double handle = random.Uniform(0.04, 0.055);
  AddHandle(model.surface, {radius + 0.7 * flare, 0.84 * height},
            {radius + 0.1 * flare + 0.01, random.Uniform(0.2, 0.3) * height},
            radius + random.Uniform(0.26, 0.36), handle);
  return model;
}

SampleModel MakeTeapot(Random& random) {
  const double radius = random.Uniform(0.4, 0.5);
  const double height = random.Uniform(0.55, 0.75);
  const double neck = radius * random.Uniform(0.5, 0.65);
  Outline profile = SmoothCurve({{radius * 0.6, 0},
                                 {radius * 0.94, 0.22 * height},
                                 {radius, 0.5 * height},
                                 {radius * 0.88, 0.8 * height},
                                 {neck, height}},
                                6, false);
  profile.insert(profile.begin(), Vector2d(0, 0));
  profile.emplace_back(0, height);
  SampleModel model{.surface = {}, .genus = 1};
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("body");
  surface.Add(MakeLathe(Pose::Identity(), profile, 0.015));
  surface.BeginPart("lid");
  surface.Add(MakeEllipsoid(At(0, 0, height), {neck * 0.95, neck * 0.95, 0.1}),
              0.015);
  surface.Add(
      MakeCapsule({0, 0, height + 0.06}, {0, 0, height + 0.15}, 0.03, 0.055),
      0.02);
  surface.BeginPart("spout");
  const double rise = random.Uniform(0.9, 1.05) * height;
  const double reach = radius + random.Uniform(0.3, 0.42);
  const std::vector<SweepKnot> spout = {
      {{-radius * 0.8, 0, 0.3 * height}, 0.12},
      {{-radius - 0.12, 0, 0.42 * height}, 0.09},
      {{-0.3 * radius - 0.7 * reach, 0, 0.72 * height}, 0.06},
      {{-reach, 0, rise}, 0.045}};
  AddSweep(surface, spout, {.blend = 0.06, .pieces = 5});
  surface.BeginPart("handle");
  AddHandle(surface, {radius * 0.86, 0.84 * height},
            {radius * 0.92, 0.22 * height}, radius + random.Uniform(0.3, 0.4),
            random.Uniform(0.04, 0.05));
  return model;
}

SampleModel MakeVase(Random& random) {
  const double height = random.Uniform(1.0, 1.3);
  const double foot = random.Uniform(0.16, 0.22);
  const double belly = random.Uniform(0.3, 0.44);
  const double belly_at = random.Uniform(0.32, 0.55) * height;
  const double neck = random.Uniform(0.1, 0.16);
  const double lip = neck + random.Uniform(0.06, 0.14);
  const Outline side =
      SmoothCurve({{foot, 0.02},
                   {0.55 * foot + 0.45 * belly, 0.42 * belly_at},
                   {belly, belly_at},
                   {0.5 * (belly + neck), 0.45 * belly_at + 0.42 * height},
                   {neck, 0.84 * height},
                   {lip, height}},
                  6, false);
  Outline curve = {{0, 0}, {foot - 0.03, 0}};
  curve.insert(curve.end(), side.begin(), side.end());
  SampleModel model;
  model.surface.BeginPart("vessel");
  model.surface.Add(MakeShell(Pose::Identity(), curve, 0.064));
  return model;
}

SampleModel MakeChair(Random& random) {
  const double width = random.Uniform(0.21, 0.26);
  const double depth = random.Uniform(0.2, 0.25);
  const double seat = random.Uniform(0.42, 0.5);
  const double back = random.Uniform(0.42, 0.62);
  const double leg = random.Uniform(0.02, 0.028);
  const double splay = random.Uniform(0.0, 0.05);
  const int slats = static_cast<int>(random.Below(3));
  const double lean = random.Uniform(0.02, 0.1);
  SampleModel model{.surface = {}, .genus = 1 + slats};
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("seat");
  surface.Add(MakeBox(At(0, 0, seat), {width, depth, 0.012}, 0.014));
  surface.BeginPart("legs");
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const double top_x = x * (width - 0.015);
      const double top_y = y * (depth - 0.015);
      surface.Add(MakeCapsule({top_x + x * splay, top_y + y * splay, 0},
                              {top_x, top_y, seat}, 0.85 * leg, leg),
                  0.01);
    }
  }
  AddChairBack(surface, {0, depth - 0.015, seat},
               {.half_width = width - 0.015,
                .height = back,
                .lean = lean,
                .post = leg,
                .rails = slats + 1});
  return model;
}

SampleModel MakeTable(Random& random) {
  const bool round = random.Below(5) < 2;
  const double width = random.Uniform(0.5, 0.7);
  const double depth = round ? width : random.Uniform(0.3, 0.42);
  const double height = random.Uniform(0.45, 0.62);
  const double leg = random.Uniform(0.024, 0.034);
  const double inset = round ? 0.62 : 0.88;
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("top");
  if (round) {
    surface.Add(MakeLathe(At(0, 0, height),
                          RectangleOutline({0, -0.012}, {width, 0.012}), 0.01));
  } else {
    surface.Add(MakeBox(At(0, 0, height), {width, depth, 0.014}, 0.012));
  }
  surface.BeginPart("legs");
  const double splay = random.Uniform(0.0, 0.06);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const double top_x = x * (inset * width - 0.02);
      const double top_y = y * (inset * depth - 0.02);
      surface.Add(
          MakeCapsule({top_x + x * splay, top_y + y * splay, 0},
                      {top_x, top_y, height - 1.1 * leg}, 0.8 * leg, 1.1 * leg),
          0.015);
    }
  }
  return model;
}

SampleModel MakeLamp(Random& random) {
  const double lower = random.Uniform(0.45, 0.6);
  const double upper = random.Uniform(0.4, 0.55);
  const double rod = 0.022;
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("base");
  surface.Add(MakeLathe(
      Pose::Identity(),
      {{0, 0}, {0.2, 0}, {0.2, 0.015}, {0.05, 0.05}, {0, 0.05}}, 0.012));
  surface.BeginPart("arm");
  const Pose shoulder = At(0, 0, 0.06) * TurnY(random.Uniform(-35, -10));
  const Pose elbow =
      shoulder * At(0, 0, lower) * TurnY(random.Uniform(60, 110));
  const Pose head = elbow * At(0, 0, upper) * TurnY(random.Uniform(40, 80));
  surface.Add(
      MakeCapsule(shoulder.translation(), elbow.translation(), rod, rod), 0.02);
  surface.Add(MakeCapsule(elbow.translation(), head.translation(), rod, rod),
              0.01);
  surface.Add(MakeEllipsoid(elbow, {0.04, 0.04, 0.04}), 0.01);
  surface.BeginPart("shade");
  const double mouth = random.Uniform(0.17, 0.22);
  const double length = random.Uniform(0.24, 0.3);
  const Outline curve = SmoothCurve(
      {{0, -0.03}, {0.06, -0.02}, {0.085, 0.08}, {mouth, length}}, 5, false);
  surface.Add(MakeShell(head, curve, 0.036), 0.012);
  return model;
}

}  // namespace argmesh
