// The headers that tests share are precompiled with the flags of this source (CMakeLists.txt).
