// Gives the precompiled header of all tests a translation unit to hang on.
