// SPDX-License-Identifier: MIT
#include "model/export/languages.hpp"

namespace lacuna {
namespace {

/// Begins the names of what exports define.
constexpr std::string_view kOwn = "lacuna_";

}  // namespace

const NameRules& c_names() {
  static const NameRules rules = {
      .words = words_of(
          "alignas alignof and and_eq asm auto bitand bitor bool break case catch char "
          "char16_t "
          "char32_t char8_t class co_await co_return co_yield compl concept const const_cast "
          "consteval constexpr constinit continue decltype default delete do double "
          "dynamic_cast else enum explicit export extern false float for friend goto if inline "
          "int long mutable namespace new noexcept not not_eq nullptr operator or or_eq "
          "private "
          "protected public register reinterpret_cast requires restrict return short signed "
          "sizeof static static_assert static_cast struct switch template this thread_local "
          "throw true try typedef typeid typename typeof typeof_unqual union unsigned using "
          "virtual void volatile wchar_t while xor xor_eq "
          "final import module override std "
          "fabs pow t state_ input_ rate_ output_ jacobian_ "
          "NULL NAN INFINITY EOF MAXFLOAT MATH_ERRNO MATH_ERREXCEPT math_errhandling errno "
          "assert offsetof DOMAIN SING OVERFLOW UNDERFLOW TLOSS PLOSS EDOM ERANGE "
          "BIG_ENDIAN LITTLE_ENDIAN PDP_ENDIAN BYTE_ORDER EXIT_FAILURE EXIT_SUCCESS "
          "FD_SETSIZE NFDBITS MB_CUR_MAX RAND_MAX WCONTINUED WEXITED WNOHANG WNOWAIT WSTOPPED "
          "WUNTRACED linux unix i386 near far huge small interface"),
      .prefixes = {kOwn, "M_", "FP_", "HUGE_VAL", "SNAN"}};
  return rules;
}

const NameRules& python_names() {
  static const NameRules rules = {
      .words = words_of(
          "False None True and as assert async await break case class continue def del elif "
          "else except finally for from global if import in is lambda match nonlocal not or "
          "pass raise return try type while with yield "
          "np numpy rate output t state inputs parameters PARAMETERS INITIAL "
          "abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr "
          "classmethod compile complex copyright credits delattr dict dir divmod enumerate "
          "eval "
          "exec exit filter float format frozenset getattr globals hasattr hash help hex id "
          "input int isinstance issubclass iter len license list locals map max memoryview min "
          "next object oct open ord pow print property quit range repr reversed round set "
          "setattr slice sorted staticmethod str sum super tuple vars zip "
          "Ellipsis NotImplemented"),
      .prefixes = {kOwn}};
  return rules;
}

const NameRules& matlab_names() {
  static const NameRules rules = {
      .words = words_of(
          "arguments break case catch classdef continue do else elseif end end_try_catch "
          "end_unwind_protect endarguments endclassdef endenumeration endevents endfor "
          "endfunction endif endmethods endparfor endproperties endspmd endswitch endwhile "
          "enumeration events for function get global if import methods otherwise parfor "
          "persistent properties return set spmd static switch try until unwind_protect "
          "unwind_protect_cleanup while "
          "t state input rate output initial parameter double imag isreal nan NaN NA inf Inf "
          "eps e i j I J pi ans "
          "nargin nargout varargin varargout isargout argv realmax realmin"),
      .prefixes = {kOwn}};
  return rules;
}

const NameRules& modelica_names() {
  static const NameRules rules = {
      .words = words_of(
          "algorithm and annotation assert block break class connect connector constant "
          "constrainedby der discrete each else elseif elsewhen encapsulated end enumeration "
          "equation expandable extends external false final flow for function if import impure "
          "in initial inner input loop model not operator or outer output package parameter "
          "partial protected public pure record redeclare replaceable return stream then true "
          "type when while within "
          "time t Real Integer Boolean String Clock StateSelect AssertionLevel ExternalObject "
          "Modelica Connections LacunaModel "
          "div mod rem ceil floor integer log10 atan2 sinh cosh homotopy semiLinear delay "
          "spatialDistribution cardinality noEvent smooth sample pre edge change reinit "
          "terminal terminate inStream actualStream getInstanceName ndims size scalar vector "
          "matrix identity diagonal zeros ones fill linspace transpose outerProduct symmetric "
          "cross skew cat array promote sum product rooted isPresent hold previous subSample "
          "superSample shiftSample backSample interval firstTick activeState initialState "
          "transition ticksInState timeInState"),
      .prefixes = {kOwn}};
  return rules;
}

const NameRules& spice_names() {
  static const NameRules rules = {
      .words = words_of("gnd t time temper temp hertz null params param poly table value vol "
                        "cur m tc tc1 tc2 "
                        "dtemp scale off on ic lacuna_model"),
      .prefixes = {kOwn},
      .case_blind = true};
  return rules;
}

const NameRules& latex_names() {
  static const NameRules rules = {.underscores = true};
  return rules;
}

}  // namespace lacuna
