// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "VoxelFile.h"

#include "vtk_zlib.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include "math/Require.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
constexpr std::int64_t block = 1 << 18;    // bytes that are read at once
constexpr std::int64_t mostSmaller = 1032; // the most that zlib can compress anything

std::int64_t SizeOf(const std::string& path)
{
  return static_cast<std::int64_t>(vtksys::SystemTools::FileLength(path));
}

void Open(const std::string& path, vtksys::ifstream& stream)
{
  stream.open(path.c_str(), std::ios::in | std::ios::binary);
  LIMPID_REQUIRE(stream && !vtksys::SystemTools::FileIsDirectory(path),
    "There is no file \"" << path
                          << "\" that can be opened (it has the values). Correct its path.");
}

std::int64_t ReadSome(vtksys::ifstream& stream, char* bytes, std::int64_t count)
{
  stream.read(bytes, static_cast<std::streamsize>(count));
  return static_cast<std::int64_t>(stream.gcount());
}

// Decompresses a stream, of which the parts are as gzip or as zlib makes them.
class Inflater
{
public:
  explicit Inflater(vtksys::ifstream& stream)
    : Stream(stream)
    , Input(block)
  {
    constexpr int anyHeader = 15 + 32; // of gzip and of zlib
    LIMPID_REQUIRE(inflateInit2(&this->State, anyHeader) == Z_OK,
      "There is not enough memory for decompression (the values are compressed). Close other "
      "programs.");
  }
  ~Inflater() { inflateEnd(&this->State); }
  Inflater(const Inflater&) = delete;
  void operator=(const Inflater&) = delete;

  // Returns the number of bytes, which is smaller than `count` at the end alone.
  std::int64_t Read(char* bytes, std::int64_t count)
  {
    std::int64_t done = 0;
    int outcome = Z_OK;
    while (done < count && outcome != Z_BUF_ERROR) // that is, nothing is left
    {
      this->Refill();
      const std::int64_t here = std::min(count - done, std::int64_t{ 1 } << 30);
      this->State.next_out = reinterpret_cast<Bytef*>(bytes + done);
      this->State.avail_out = static_cast<uInt>(here);
      outcome = inflate(&this->State, Z_NO_FLUSH);
      done += here - static_cast<std::int64_t>(this->State.avail_out);
      LIMPID_REQUIRE(outcome == Z_OK || outcome == Z_BUF_ERROR || outcome == Z_STREAM_END,
        "The compressed values are damaged after " << done
                                                   << " bytes (they cannot be decompressed). Copy "
                                                      "or write the file again.");
      if (outcome == Z_STREAM_END)
      {
        inflateReset(&this->State);
        this->Refill();
        const bool isGzip = this->State.avail_in > 0 && *this->State.next_in == 0x1F;
        outcome = isGzip ? Z_OK : Z_BUF_ERROR; // another part may follow, or padding
      }
    }
    return done;
  }

private:
  void Refill()
  {
    if (this->State.avail_in == 0)
    {
      const std::int64_t read = ReadSome(this->Stream, this->Input.data(), block);
      this->State.next_in = reinterpret_cast<Bytef*>(this->Input.data());
      this->State.avail_in = static_cast<uInt>(read);
    }
  }

  vtksys::ifstream& Stream;
  std::vector<char> Input;
  z_stream State{};
};

std::int64_t Decompress(
  vtksys::ifstream& stream, std::int64_t skip, char* bytes, std::int64_t count)
{
  Inflater inflater(stream);
  std::vector<char> skipped(static_cast<std::size_t>(std::min(skip, block)));
  for (std::int64_t left = skip; left > 0;)
  {
    const std::int64_t read = inflater.Read(skipped.data(), std::min(left, block));
    if (read == 0)
    {
      return 0;
    }
    left -= read;
  }
  return inflater.Read(bytes, count);
}
}

bool IsGzip(const std::string& path)
{
  vtksys::ifstream stream;
  Open(path, stream);
  return stream.get() == 0x1F && stream.get() == 0x8B;
}

std::int64_t ReadBytes(const VoxelFile& file, char* bytes, std::int64_t count)
{
  vtksys::ifstream stream;
  Open(file.path, stream);
  const bool isAtEnd = file.offset == VoxelFile::atEnd;
  stream.seekg(isAtEnd ? std::max(SizeOf(file.path) - count, std::int64_t{ 0 }) : file.offset);
  if (file.isCompressed)
  {
    return Decompress(stream, file.skip, bytes, count);
  }
  stream.seekg(file.skip, std::ios::cur);
  return ReadSome(stream, bytes, count);
}

void RequireBytes(const VoxelFile& file, std::int64_t count)
{
  const std::int64_t stored = SizeOf(file.path) - std::max(file.offset, std::int64_t{ 0 });
  const std::int64_t most = (file.isCompressed ? mostSmaller * stored : stored) - file.skip;
  LIMPID_REQUIRE(most >= count,
    "The file \"" << file.path << "\" has at most " << std::max(most, std::int64_t{ 0 })
                  << " bytes of values, and its header announces " << count
                  << " (it is cut short, or the header is wrong). Copy or write it again.");
}
}
