// write_uf2 ELF UF2: makes the file for the RP2040's boot loader out of a linked program. The build runs it.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "passo/chip/uf2.hpp"

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "write_uf2 ELF UF2\n");
    return 2;
  }
  std::ifstream in(words[1], std::ios::binary);
  const std::vector<char> read{std::istreambuf_iterator<char>(in), {}};
  const std::vector<std::uint8_t> elf(read.begin(), read.end());
  const auto flash = passo::flash_of_elf(elf);
  if (!flash) {
    std::fprintf(stderr, "%s: %s\n", words[1], flash.error().c_str());
    return 1;
  }
  const std::vector<std::uint8_t> uf2 = passo::uf2_of_flash(*flash);
  std::ofstream out(words[2], std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(uf2.data()), static_cast<std::streamsize>(uf2.size()));
  out.close();
  if (!out) {
    std::fprintf(stderr, "%s: cannot be written\n", words[2]);
    return 1;
  }
  return 0;
}
