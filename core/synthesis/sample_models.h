// The models behind the classes of the sample collection: each draws its
// proportions and joint angles from a seeded generator.
//
// Shapes stand upright on z, look along -y and are about one unit long.
#ifndef ARGMESH_CORE_SYNTHESIS_SAMPLE_MODELS_H_
#define ARGMESH_CORE_SYNTHESIS_SAMPLE_MODELS_H_

#include "core/base/random.h"
#include "core/synthesis/implicit_surface.h"

namespace argmesh {

struct SampleModel {
  ImplicitSurface surface;
  int genus = 0;  // handles of the closed surface
};

// sample_models_household.cc
SampleModel MakeMug(Random& random);
SampleModel MakeTeapot(Random& random);
SampleModel MakeVase(Random& random);
SampleModel MakeChair(Random& random);
SampleModel MakeTable(Random& random);
SampleModel MakeLamp(Random& random);

// sample_models_tools.cc
SampleModel MakePliers(Random& random);
SampleModel MakeWrench(Random& random);
SampleModel MakeKey(Random& random);
SampleModel MakeGear(Random& random);
SampleModel MakeGlasses(Random& random);
SampleModel MakeAirplane(Random& random);

// sample_models_animals.cc
SampleModel MakeQuadruped(Random& random);
SampleModel MakeBird(Random& random);
SampleModel MakeFish(Random& random);
SampleModel MakeOctopus(Random& random);
SampleModel MakeAnt(Random& random);

// sample_models_bodies.cc
SampleModel MakeHuman(Random& random);
SampleModel MakeHand(Random& random);

}  // namespace argmesh

#endif  // ARGMESH_CORE_SYNTHESIS_SAMPLE_MODELS_H_
