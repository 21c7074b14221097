// A library that has nothing to do with the engine.
extern "C" int foreign_function() {
    return 0;
}
