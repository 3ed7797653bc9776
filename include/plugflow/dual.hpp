/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * dual.hpp -- terms in C++ (17), written once.  A term is a struct: its members are the parameters, its template
 * `point` is what happens at the points of a batch,
 *
 *     struct drag {
 *         double resistance;
 *         template <class num> int point(const pf_batch &b, const num *const *in, num *const *out) const
 *         {
 *             const plugflow::rows<const num> u(b, in[0]);
 *             const plugflow::rows<num> v(b, out[0]);
 *
 *             for (uint32_t a = 0; a < b.dim; a++)
 *                 for (uint32_t i = 0; i < b.ld; i++)
 *                     v(a, i) = resistance * u(a, i);
 *             return PF_OK;
 *         }
 *     };
 *
 * and plugflow::term<drag>("drag", PF_CELL, in, out, param) has it for numbers and for dual numbers a + a' eps,
 * eps^2 = 0, whose second part carries a derivative through every operation.  That is what the kernel's complex
 * step asks for, as its step is 1e-100.  See tests/abi/kit/drag.cpp.  Functions: sqrt exp log sin cos tan tanh atan
 * fabs pow, max min (with `using plugflow::max`). */
#ifndef PLUGFLOW_DUAL_HPP
#define PLUGFLOW_DUAL_HPP

#include <plugflow/plugin.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plugflow
{

struct dual {
    double re, im;

    dual() = default;
    constexpr dual(double value, double derivative = 0) : re(value), im(derivative)
    {
    }
    dual &operator+=(dual y)
    {
        return *this = dual(re + y.re, im + y.im);
    }
    dual &operator-=(dual y)
    {
        return *this = dual(re - y.re, im - y.im);
    }
    dual &operator*=(dual y)
    {
        return *this = dual(re * y.re, re * y.im + im * y.re);
    }
    dual &operator/=(dual y)
    {
        return *this = dual(re / y.re, (im - re / y.re * y.im) / y.re);
    }
    friend dual operator+(dual x, dual y)
    {
        return x += y;
    }
    friend dual operator-(dual x, dual y)
    {
        return x -= y;
    }
    friend dual operator*(dual x, dual y)
    {
        return x *= y;
    }
    friend dual operator/(dual x, dual y)
    {
        return x /= y;
    }
    friend dual operator-(dual x)
    {
        return dual(-x.re, -x.im);
    }
    friend bool operator<(dual x, dual y)
    {
        return x.re < y.re;
    }
    friend bool operator>(dual x, dual y)
    {
        return x.re > y.re;
    }
    friend bool operator<=(dual x, dual y)
    {
        return x.re <= y.re;
    }
    friend bool operator>=(dual x, dual y)
    {
        return x.re >= y.re;
    }
};

static_assert(sizeof(dual) == sizeof(pf_complex), "a dual number is where the kernel has a complex one");

/* f(x) and its derivative; where nothing moves, a slope that is not finite does no harm. */
inline dual chain(dual x, double value, double slope)
{
    return dual(value, x.im == 0 ? 0 : x.im * slope);
}

inline dual sqrt(dual x)
{
    const double y = std::sqrt(x.re);

    return chain(x, y, 0.5 / y);
}

inline dual exp(dual x)
{
    const double y = std::exp(x.re);

    return chain(x, y, y);
}

inline dual log(dual x)
{
    return chain(x, std::log(x.re), 1 / x.re);
}

inline dual sin(dual x)
{
    return chain(x, std::sin(x.re), std::cos(x.re));
}

inline dual cos(dual x)
{
    return chain(x, std::cos(x.re), -std::sin(x.re));
}

inline dual tan(dual x)
{
    const double y = std::tan(x.re);

    return chain(x, y, 1 + y * y);
}

inline dual tanh(dual x)
{
    const double y = std::tanh(x.re);

    return chain(x, y, 1 - y * y);
}

inline dual atan(dual x)
{
    return chain(x, std::atan(x.re), 1 / (1 + x.re * x.re));
}

inline dual fabs(dual x)
{
    return x.re < 0 ? -x : x;
}

inline dual pow(dual x, double e)
{
    return chain(x, std::pow(x.re, e), e * std::pow(x.re, e - 1));
}

inline dual pow(dual x, dual e)
{
    const double y = std::pow(x.re, e.re);

    return pow(x, e.re) + dual(0, e.im == 0 ? 0 : e.im * y * std::log(x.re));
}

inline double max(double x, double y)
{
    return x < y ? y : x;
}

inline dual max(dual x, dual y)
{
    return x < y ? y : x;
}

inline double min(double x, double y)
{
    return y < x ? y : x;
}

inline dual min(dual x, dual y)
{
    return y < x ? y : x;
}

/* A slot, or what the batch has: s(i) of a scalar, u(a, i) of a vector, grad_u(a, k, i) of a tensor, i the point.
 */
template <class num> class rows
{
    num *__restrict row;
    const std::size_t ld, dim;

  public:
    rows(const pf_batch &b, num *first) : row(first), ld(b.ld), dim(b.dim)
    {
    }
    num &operator()(std::size_t i) const
    {
        return row[i];
    }
    num &operator()(std::size_t a, std::size_t i) const
    {
        return row[a * ld + i];
    }
    num &operator()(std::size_t a, std::size_t k, std::size_t i) const
    {
        return row[(a * dim + k) * ld + i];
    }
};

/* Parameters are copied, as numbers on the stack are changed by no output, and the point function is there twice,
 * so that loops over directions are unrolled. */
template <class T, class num> int at_points(const pf_batch *b, const num *const *in, num *const *out)
{
    const T t = *static_cast<const T *>(b->params);

    return b->dim == 2 ? t.point(*b, in, out) : b->dim == 3 ? t.point(*b, in, out) : PF_FAIL;
}

template <class T> int residual(const pf_batch *b, const double *const *in, double *const *out)
{
    return at_points<T>(b, in, out);
}

template <class T> int twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    return at_points<T>(b, reinterpret_cast<const dual *const *>(in), reinterpret_cast<dual *const *>(out));
}

/* A term whose texts are to be filled in: doc, cite; and flags, examples, check, ... where it has them. */
template <class T, std::size_t n_in, std::size_t n_out, std::size_t n_param>
pf_term term(const char *name, uint32_t where, const pf_slot (&in)[n_in], const pf_slot (&out)[n_out],
             const pf_param (&param)[n_param])
{
    pf_term t = {};

    t.size = sizeof(pf_term), t.slot_size = sizeof(pf_slot), t.param_size = sizeof(pf_param);
    t.example_size = sizeof(pf_example), t.params_bytes = sizeof(T);
    t.name = name, t.where = where;
    t.in = in, t.n_in = n_in, t.out = out, t.n_out = n_out, t.param = param, t.n_param = n_param;
    t.residual = residual<T>, t.residual_c = twin<T>;
    return t;
}

/* A plugin whose texts are to be filled in: author, license, doc. */
template <std::size_t n_field, std::size_t n_term>
pf_plugin plugin(const char *name, const pf_field (&field)[n_field], const pf_term *const (&terms)[n_term])
{
    pf_plugin p = {};

    p.size = sizeof(pf_plugin), p.major = PF_ABI_MAJOR, p.minor = p.min_minor = PF_ABI_MINOR, p.sizes = PF_SIZES;
    p.field_size = sizeof(pf_field), p.field = field, p.n_field = n_field, p.term = terms, p.n_term = n_term;
    p.name = name, p.version = "1.0", p.author = "", p.license = "not stated", p.doc = "";
    return p;
}

} // namespace plugflow

#endif
