// What a page does for a module that reads programs (interfaces/browser/wasm): it reads the visitor's files, and shows
// how far the check is.
#pragma once

#include <cstddef>

#define PASSO_IMPORT(name) __attribute__((import_module("host"), import_name(#name))) host_##name

extern "C" {

// The size of a file in bytes; negative: the page has no file of this name.
double PASSO_IMPORT(size)(const char* name, std::size_t length);
// Reads up to `size` bytes and returns their number; negative: the browser could not read the file.
int PASSO_IMPORT(read)(const char* name, std::size_t length, char* to, std::size_t size, double offset);
// `stage`: CheckStage.
void PASSO_IMPORT(progress)(int stage, double share);
}
