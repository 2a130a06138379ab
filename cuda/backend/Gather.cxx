// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Gather.h"

#include "backend/Simd.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define LIMPID_X86 1
#include <immintrin.h>
#endif

namespace limpid
{
namespace
{
void InterpolateScalar(const float* __restrict source, const int* __restrict index,
  const float* __restrict weight, int count, float* __restrict out)
{
  for (int i = 0; i < count; ++i)
  {
    const float a = source[index[i]];
    const float b = source[index[i] + 1];
    out[i] = a + weight[i] * (b - a);
  }
}

#ifdef LIMPID_X86
/// Interpolates 16 targets at a time whose sources are in two registers.
__attribute__((target("avx512f"))) void InterpolateAvx512(
  const float* source, const int* index, const float* weight, int count, float* out)
{
  for (int i = 0; i < count; i += 16)
  {
    const int many = count - i < 16 ? count - i : 16;
    const auto mask = static_cast<__mmask16>((1u << many) - 1);
    const int first = index[i];
    const __m512i at =
      _mm512_sub_epi32(_mm512_maskz_loadu_epi32(mask, index + i), _mm512_set1_epi32(first));
    __m512 a;
    __m512 b;
    if (index[i + many - 1] - first < 31)
    {
      const __m512 low = _mm512_loadu_ps(source + first);
      const __m512 high = _mm512_loadu_ps(source + first + 16);
      a = _mm512_permutex2var_ps(low, at, high);
      b = _mm512_permutex2var_ps(low, _mm512_add_epi32(at, _mm512_set1_epi32(1)), high);
    }
    else
    {
      const __m512 zero = _mm512_setzero_ps(); // the unmasked form triggers warnings of GCC 12
      a = _mm512_mask_i32gather_ps(zero, mask, at, source + first, 4);
      b = _mm512_mask_i32gather_ps(zero, mask, at, source + first + 1, 4);
    }
    const __m512 t = _mm512_maskz_loadu_ps(mask, weight + i);
    _mm512_mask_storeu_ps(out + i, mask, _mm512_fmadd_ps(t, _mm512_sub_ps(b, a), a));
  }
}

/// Interpolates 8 targets at a time whose sources are in two registers.
__attribute__((target("avx2,fma"))) void InterpolateAvx2(
  const float* source, const int* index, const float* weight, int count, float* out)
{
  const __m256i seven = _mm256_set1_epi32(7);
  const auto pick = [&](__m256 low, __m256 high, __m256i at) __attribute__((target("avx2,fma")))
  {
    const __m256 fromHigh = _mm256_permutevar8x32_ps(high, at);
    const __m256 fromLow = _mm256_permutevar8x32_ps(low, at);
    return _mm256_blendv_ps(fromLow, fromHigh, _mm256_castsi256_ps(_mm256_cmpgt_epi32(at, seven)));
  };
  int i = 0;
  for (; i + 8 <= count; i += 8)
  {
    const int first = index[i];
    const __m256i at = _mm256_sub_epi32(
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index + i)), _mm256_set1_epi32(first));
    __m256 a;
    __m256 b;
    if (index[i + 7] - first < 15)
    {
      const __m256 low = _mm256_loadu_ps(source + first);
      const __m256 high = _mm256_loadu_ps(source + first + 8);
      a = pick(low, high, at);
      b = pick(low, high, _mm256_add_epi32(at, _mm256_set1_epi32(1)));
    }
    else
    {
      a = _mm256_i32gather_ps(source + first, at, 4);
      b = _mm256_i32gather_ps(source + first + 1, at, 4);
    }
    const __m256 t = _mm256_loadu_ps(weight + i);
    _mm256_storeu_ps(out + i, _mm256_fmadd_ps(t, _mm256_sub_ps(b, a), a));
  }
  InterpolateScalar(source, index + i, weight + i, count - i, out + i);
}
#endif

using Interpolate = void (*)(const float*, const int*, const float*, int, float*);

Interpolate ChooseInterpolate()
{
#ifdef LIMPID_X86
  if (__builtin_cpu_supports("avx512f"))
  {
    return InterpolateAvx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return InterpolateAvx2;
  }
#endif
  return InterpolateScalar;
}
}

void InterpolateGathered(
  const float* source, const int* index, const float* weight, int count, float* out)
{
  static const Interpolate interpolate = ChooseInterpolate();
  interpolate(source, index, weight, count, out);
}
}
