// SPDX-License-Identifier: MIT
#include "effects.hpp"

#include "bindings.hpp"

namespace diabolo::python {

namespace {

using namespace py::literals;

using Elasticity = StringElasticity<double>;

// A new effect may have a text here, and shortcuts where its fields alone are awkward.

template <class Effect>
const char* doc_of(const Effect&) {
  return "An effect; fields() lists its parameters.";
}

const char* doc_of(const Elasticity&) {
  return R"(A string that stretches.

Its tension is stiffness times extension plus damping times the extension's rate, while positive. The
amplitude is the compliance, so that zero, the default, is the rigid string.)";
}

const char* doc_of(const StringFriction<double>&) {
  return R"(A string that rubs on the axle: Euler's and Eytelwein's capstan law.

While it slips towards the right tip, T_right / T_left = exp(coefficient * contact angle). The difference turns
the axle, too: dw/dt = spin_gain (T_right - T_left) / mass. It adds to Parameters.spin_coupling, which
stands for the same torque as a rate; set that to zero where friction alone drives the spin.)";
}

const char* doc_of(const StickFlex<double>&) {
  return R"(Sticks that bend: each tip gives by compliance times the string's pull, square to its stick.)";
}

const char* doc_of(const StringMass<double>&) {
  return R"(A string that weighs something: while it is loose, half of it hangs on the diabolo.)";
}

const char* doc_of(const LandingRestitution<double>&) {
  return R"(A catch that bounces: of the rate at which a string that comes taut would stretch, so much is given back.)";
}

const char* doc_of(const Air<double>&) {
  return R"(Air that holds the diabolo back: a = -(linear_drag + quadratic_drag |u|) u, u = v - wind.)";
}

const char* doc_of(const MagnusLift<double>&) {
  return R"(Lift of a spinning diabolo: a = coefficient * omega x v, omega = -spin * axis.)";
}

const char* doc_of(const SpinLoss<double>&) {
  return R"(What slows the spin beside the string: dw/dt = -air w|w| - axle sign(w).)";
}

const char* doc_of(const GravityTilt<double>&) {
  return R"(Gravity along (x, y, -sqrt(1 - x^2 - y^2)) instead of -z: a frame that is not level.)";
}

const char* doc_of(const GyroscopicTilt<double>&) {
  return R"(Strands that leave the axle aside turn it: gain = m r / I, I the axial moment of inertia.

Without an inertia_ratio the axle follows slowly, ds/dt = torque / (I w). With one, the transverse over the axial
moment of inertia (1 to 1.4), the diabolo is a rigid body that nutes, State.tumble its axle's angular velocity.)";
}

const char* doc_of(const UnnamedForce<double>&) {
  return R"(A force without a name, as a diagnosis found it: accelerations times powers of speed and spin.

Each amplitude [m/s^2] is that at 1 m/s and 100 rad/s; on the string along it (towards the right tip) and square to
its plane, off it against the velocity, up, and along omega x v. It stops growing below 0.05 and above 20 m/s, below
1 and above 1000 rad/s.)";
}

const char* doc_of(const Unbalance<double>&) {
  return R"(Cups of unlike weight: the centre of mass lies `offset` beside the groove, along the axle.

It yaws the axle, where a GyroscopicTilt has its gain.)";
}

const char* doc_of(const Groove<double>&) {
  return R"(A round groove whose flanks the string climbs, towards the tips.

The string then pulls from up to half_width beside the centre and yaws the axle, where a GyroscopicTilt has its gain;
at the edge it brakes the spin by flank_brake times the force along the axle over the mass.)";
}

const char* doc_of(const FiniteAxle<double>&) {
  return R"(An axle that is not thin: string lies around it, and the strands leave it along its tangents.)";
}

template <class Effect>
void bind_shortcuts(py::class_<Effect>&) {}

void bind_shortcuts(py::class_<Elasticity>& cls) {
  const auto of_stiffness = [](double stiffness, double damping) {
    const Elasticity elasticity = Elasticity::of_stiffness(stiffness, damping);
    validate_effect(elasticity);
    return elasticity;
  };
  cls.def_static("of_stiffness", of_stiffness, "stiffness"_a, "damping"_a = 0.0,
                 "Stiffness [N/m] and damping [N s/m] of the path length.");
}

/// Any effect of the library: its fields are its properties and the keywords of its constructor.
template <class Effect>
void bind_effect(py::module_& module, const Effect& nominal) {
  const std::string name = class_name(Effect::kName);
  py::class_<Effect> cls(module, name.c_str(), doc_of(nominal));
  cls.def(py::init([](const py::kwargs& fields) { return effect_from_dict<Effect>(fields); }));
  cls.def_static("fields", &list_of_infos<Effect>, "Name, unit and range of every field (ParameterInfo).");
  bind_shortcuts(cls);
  bind_numbers(cls, &validate_effect<Effect>);
  cls.def("to_dict", &effect_to_dict<Effect>, "All fields by name.");
  cls.def("__repr__", [name](const Effect& effect) {
    return call_text(name, effect_to_dict(effect), effect_to_dict(Effect{}));
  });
  bind_copies(cls, &effect_to_dict<Effect>, &effect_from_dict<Effect>);
}

}  // namespace

void assign_effect(AllEffects<double>& effects, const std::string& name, const py::object& given) {
  // (A list is made laws by their class, whose sentence says what is wrong with one.)
  const bool listed = name == FormulaLaws<double>::kName &&
                      (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given));
  const py::object value = listed ? py::type::of<FormulaLaws<double>>()(given) : given;
  std::string names;
  bool found = false;
  const auto assign = [&]<class Effect>(Effect& effect, const char* expected) {
    if (name != Effect::kName) return;
    effect = value.is_none() ? Effect{} : cast_to<Effect>(value, name, expected);
    found = true;
  };
  assign(effects.get<FormulaLaws>(), "FormulaLaws, a list of laws or None");
  assign(effects.get<ResidualForce>(), "ResidualForce or None");
  for_each_effect(effects, [&](auto& effect) {
    names.append(effect.kName).append(", ");
    assign(effect, (class_name(effect.kName) + " or None").c_str());
  });
  if (!found)
    throw py::type_error("unexpected keyword '" + name + "'; the effects are: " + names +
                         "formula_laws, residual_force");
}

void assign_effects(AllEffects<double>& effects, const py::kwargs& given) {
  for (const auto& [name, value] : given)
    assign_effect(effects, py::str(name), py::reinterpret_borrow<py::object>(value));
}

void bind_effects(py::module_& module) {
  const AllEffects<double> effects;
  for_each_effect(effects, [&](const auto& effect) { bind_effect(module, effect); });
}

}  // namespace diabolo::python
