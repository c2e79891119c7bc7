// What the thread sanitizer cannot see: locks inside Debian's ray tracer, which
// is not instrumented. Of no effect in other builds.
extern "C" const char* __tsan_default_suppressions();

extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libembree3.so\n"
         "called_from_lib:libtbb.so\n"
         "race:libembree3.so\n";
}
