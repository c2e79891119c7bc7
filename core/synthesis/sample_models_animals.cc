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

struct QuadrupedSize {
  double body = 0.6;  // between shoulder and hip
  double girth = 0.15;
  double leg = 0.5;  // shoulder to ground
  double neck = 0.3;
  double neck_angle = 40;  // above the horizontal, degrees
  double head = 0.12;
};

// Upper leg, lower leg and hoof from a joint at the body; angles in degrees.
void AddLeg(ImplicitSurface& surface, const Pose& joint, double length,
            double swing, double bend) {
  const double upper = 0.5 * length;
  const double lower = 0.46 * length;
  const Pose hip = joint * TurnX(swing);
  const Pose knee = hip * At(0, 0, -upper) * TurnX(bend);
  const Pose ankle = knee * At(0, 0, -lower);
  surface.Add(MakeCapsule(hip.translation(), knee.translation(), 0.17 * length,
                          0.085 * length),
              0.05);
  surface.Add(MakeCapsule(knee.translation(), ankle.translation(),
                          0.08 * length, 0.06 * length),
              0.015);
  const Vector3d toe = ankle * Vector3d(0, -0.07 * length, -0.01);
  surface.Add(
      MakeCapsule(ankle.translation(), toe, 0.07 * length, 0.06 * length),
      0.01);
}

void AddQuadrupedHead(ImplicitSurface& surface, const QuadrupedSize& size,
                      Random& random) {
  surface.BeginPart("neck");
  const Pose neck = At(0, -0.5 * size.body, size.leg + 0.35 * size.girth) *
                    TurnX(90 - size.neck_angle);
  const Pose nape = neck * At(0, 0, size.neck);
  surface.Add(MakeCapsule(neck.translation(), nape.translation(),
                          0.62 * size.girth, 0.42 * size.girth),
              0.06);
  surface.BeginPart("head");
  const Pose head = At(nape.translation()) * TurnX(random.Uniform(15, 40)) *
                    TurnZ(random.Uniform(-20, 20));
  const double h = size.head;
  surface.Add(MakeCapsule(head * Vector3d(0, 0.1 * h, 0),
                          head * Vector3d(0, -1.5 * h, 0), 0.62 * h, 0.34 * h),
              0.03);
  for (const double side : {-1.0, 1.0}) {
    surface.Add(MakeCapsule(head * Vector3d(side * 0.35 * h, 0.25 * h, 0.3 * h),
                            head * Vector3d(side * 0.55 * h, 0.3 * h, 1.15 * h),
                            0.22 * h, 0.17 * h),
                0.01);
  }
}

// The y axis is the fish's: outlines (x, y) become (y, z).
Pose UprightOutline() {
  Pose upright = Pose::Identity();
  upright.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return upright;
}

// A dorsal fin up to `high`, an anal fin and two pectoral fins.
void AddFins(ImplicitSurface& surface, double tall, double wide, double high) {
  const Pose upright = UprightOutline();
  surface.BeginPart("fins");
  const Outline dorsal = {{-0.2, 0.7 * tall},
                          {-0.06, high},
                          {0.1, high - 0.05},
                          {0.14, 0.45 * tall}};
  surface.Add(MakeExtrusion(upright, dorsal, 0.002, 0.015), 0.02);
  const Outline anal = {
      {0.0, -0.7 * tall}, {0.14, -tall - 0.05}, {0.17, -0.4 * tall}};
  surface.Add(MakeExtrusion(upright, anal, 0.002, 0.015), 0.02);
  for (const double side : {-1.0, 1.0}) {
    const Pose shoulder = At(side * 0.75 * wide, -0.2, -0.25 * tall) *
                          TurnZ(side * 20) * TurnY(side * 35);
    const Outline fin = {
        {0, -0.03}, {side * 0.14, 0.04}, {side * 0.12, 0.11}, {0, 0.04}};
    surface.Add(MakeExtrusion(shoulder, fin, 0.002, 0.015), 0.01);
  }
}

}  // namespace

SampleModel MakeQuadruped(Random& random) {
  QuadrupedSize size;
  size.body = random.Uniform(0.5, 0.66);
  size.girth = random.Uniform(0.13, 0.17);
  size.leg = random.Uniform(0.36, 0.6);
  size.neck = random.Uniform(0.2, 0.46);
  size.neck_angle = random.Uniform(25, 60);
  size.head = random.Uniform(0.1, 0.13);
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("trunk");
  const double z = size.leg + 0.2 * size.girth;
  const std::vector<SweepKnot> trunk = {
      {{0, -0.5 * size.body, z}, size.girth},
      {{0, 0, z - 0.02}, 0.92 * size.girth},
      {{0, 0.5 * size.body, z + 0.01}, 0.97 * size.girth}};
  AddSweep(surface, trunk, {.blend = 0.02, .pieces = 3});
  surface.BeginPart("legs");
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const double stride = random.Uniform(-28, 28);
      const double bend = random.Uniform(0, 22);
      const Pose joint = At(x * 0.55 * size.girth, y * 0.5 * size.body,
                            size.leg - 0.1 * size.girth);
      AddLeg(surface, joint, size.leg, stride - (y > 0 ? 0 : bend * 0.5),
             y > 0 ? -bend : bend);
    }
  }
  AddQuadrupedHead(surface, size, random);
  surface.BeginPart("tail");
  const double drop = random.Uniform(-0.25, 0.1);
  const double end = 0.5 * size.body + 0.8 * size.girth;
  const std::vector<SweepKnot> tail = {
      {{0, end, z + 0.08}, 0.03},
      {{0, end + 0.14, z + 0.06 + 0.4 * drop}, 0.026},
      {{random.Uniform(-0.08, 0.08), end + 0.2, z + drop}, 0.02}};
  AddSweep(surface, tail, {.blend = 0.02, .pieces = 4});
  return model;
}

SampleModel MakeBird(Random& random) {
  const double raise = random.Uniform(-5, 40);
  const double fold = random.Uniform(-20, 15);
  const double span = random.Uniform(0.26, 0.34);
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("body");
  surface.Add(MakeEllipsoid(TurnX(-12), {0.13, 0.3, 0.13}));
  surface.BeginPart("head");
  surface.Add(MakeEllipsoid(At(0, -0.31, 0.13), {0.09, 0.1, 0.09}), 0.09);
  surface.Add(MakeCapsule({0, -0.39, 0.12}, {0, -0.52, 0.09}, 0.035, 0.01),
              0.015);
  surface.BeginPart("tail");
  const Outline fan = {{-0.04, 0.2}, {-0.15, 0.58}, {0.15, 0.58}, {0.04, 0.2}};
  surface.Add(MakeExtrusion(TurnX(-8), fan, 0.002, 0.017), 0.03);
  surface.BeginPart("wings");
  for (const double side : {-1.0, 1.0}) {
    const Pose shoulder = At(side * 0.07, -0.06, 0.06) * TurnY(-side * raise);
    const Outline inner = {
        {0, -0.12}, {side * span, -0.16}, {side * span, 0.12}, {0, 0.16}};
    surface.Add(MakeExtrusion(shoulder, inner, 0.002, 0.018), 0.03);
    const Pose wrist = shoulder * At(side * span, 0, 0) * TurnY(-side * fold);
    const Outline outer = {{0, -0.16},
                           {side * 0.6 * span, -0.1},
                           {side * 1.15 * span, 0.14},
                           {side * 0.5 * span, 0.15},
                           {0, 0.12}};
    surface.Add(MakeExtrusion(wrist, outer, 0.002, 0.017), 0.01);
  }
  surface.BeginPart("legs");
  for (const double side : {-1.0, 1.0}) {
    const Vector3d hip(side * 0.06, 0.08, -0.1);
    const Vector3d foot(side * 0.07, random.Uniform(0.1, 0.22), -0.24);
    surface.Add(MakeCapsule(hip, foot, 0.028, 0.016), 0.02);
    surface.Add(MakeCapsule(foot, foot + Vector3d(side * 0.02, -0.08, -0.01),
                            0.018, 0.012),
                0.005);
  }
  return model;
}

SampleModel MakeFish(Random& random) {
  const double tall = random.Uniform(0.14, 0.22);
  const double wide = random.Uniform(0.07, 0.1);
  const double bend = random.Uniform(-25, 25);
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("body");
  surface.Add(MakeEllipsoid(At(0, -0.1, 0), {wide, 0.36, tall}));
  const Pose hip = At(0, 0.12, 0) * TurnZ(0.5 * bend);
  surface.Add(
      MakeEllipsoid(hip * At(0, 0.13, 0), {0.6 * wide, 0.25, 0.5 * tall}),
      0.12);
  surface.BeginPart("tail");
  const Pose root = hip * At(0, 0.32, 0) * TurnZ(0.5 * bend);
  const double fork = random.Uniform(0.05, 0.12);
  const Outline tail = {{-0.06, -0.015},
                        {0.2, -0.22},
                        {0.2 - fork, 0},
                        {0.2, 0.22},
                        {-0.06, 0.015}};
  surface.Add(MakeExtrusion(root * UprightOutline(), tail, 0.002, 0.015), 0.02);
  AddFins(surface, tall, wide, tall + random.Uniform(0.07, 0.13));
  return model;
}

SampleModel MakeOctopus(Random& random) {
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  surface.BeginPart("mantle");
  const Pose tilt = TurnX(random.Uniform(-25, 5));
  surface.Add(MakeEllipsoid(tilt * At(0, 0, 0.3), {0.2, 0.21, 0.27}));
  surface.Add(MakeEllipsoid(At(0, 0, 0.04), {0.15, 0.15, 0.13}), 0.06);
  surface.BeginPart("eyes");
  for (const double side : {-1.0, 1.0}) {
    surface.Add(MakeEllipsoid(At(side * 0.12, -0.1, 0.1), {0.05, 0.05, 0.05}),
                0.02);
  }
  surface.BeginPart("arms");
  const double reach = random.Uniform(0.55, 0.75);
  for (int arm = 0; arm < 8; ++arm) {
    const Pose root = TurnZ(45.0 * arm + 22.5 + random.Uniform(-5, 5));
    const double sway = random.Uniform(-0.13, 0.13);
    const double curl = random.Uniform(-0.02, 0.24);
    const double lift = random.Uniform(-0.02, 0.08);
    const std::vector<SweepKnot> knots = {
        {root * Vector3d(0.08, 0, 0.0), 0.07},
        {root * Vector3d(0.22, 0.2 * sway, -0.08), 0.058},
        {root * Vector3d(0.6 * reach, sway, -0.12 + lift), 0.042},
        {root * Vector3d(0.9 * reach, 0.2 * sway, -0.11 + 0.5 * curl), 0.03},
        {root * Vector3d(reach, -0.9 * sway, -0.1 + curl), 0.024}};
    AddSweep(surface, knots, {.blend = 0.02, .pieces = 3});
  }
  return model;
}

SampleModel MakeAnt(Random& random) {
  SampleModel model;
  ImplicitSurface& surface = model.surface;
  const double abdomen = random.Uniform(0.16, 0.27);
  surface.BeginPart("thorax");
  surface.Add(MakeEllipsoid(Pose::Identity(), {0.085, 0.17, 0.085}));
  surface.BeginPart("abdomen");
  surface.Add(MakeCapsule({0, 0.12, 0}, {0, 0.24, 0.02}, 0.04, 0.045), 0.02);
  surface.Add(MakeEllipsoid(At(0, 0.24 + 0.85 * abdomen, 0.03) *
                                TurnX(random.Uniform(-10, 10)),
                            {0.15, abdomen, 0.14}),
              0.03);
  surface.BeginPart("head");
  surface.Add(MakeEllipsoid(At(0, -0.25, 0.01), {0.12, 0.12, 0.095}), 0.02);
  for (const double side : {-1.0, 1.0}) {
    surface.Add(MakeCapsule({side * 0.05, -0.33, -0.02},
                            {side * 0.02, -0.43, -0.03}, 0.028, 0.014),
                0.01);
    surface.BeginPart("antennae");
    const double spread = random.Uniform(0.1, 0.2);
    const std::vector<SweepKnot> antenna = {
        {{side * 0.05, -0.33, 0.05}, 0.022},
        {{side * spread, -0.43, 0.16}, 0.021},
        {{side * (spread + 0.05), -0.6, 0.12}, 0.021}};
    AddSweep(surface, antenna, {.blend = 0.008, .pieces = 4});
    surface.BeginPart("legs");
    for (int leg = -1; leg <= 1; ++leg) {
      const double swing = leg * 0.17 + random.Uniform(-0.09, 0.09);
      const double knee = random.Uniform(0.08, 0.22);
      const Vector3d hip(side * 0.06, 0.09 * leg, -0.03);
      const Vector3d joint(side * 0.26, 0.09 * leg + 0.7 * swing, knee);
      const Vector3d foot(side * 0.46, 0.09 * leg + 1.6 * swing, -0.26);
      surface.Add(MakeCapsule(hip, joint, 0.03, 0.025), 0.012);
      surface.Add(MakeCapsule(joint, foot, 0.025, 0.021), 0.006);
    }
  }
  return model;
}

}  // namespace argmesh
