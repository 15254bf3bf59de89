#pragma once

namespace casimir::obstruction {

/// The part of the file for Coq that is the same for all: vectors over Q, when one is told apart
/// from others by a witness, and the two images of polynomials.
inline constexpr const char* kCoqVectors =
    R"coq((** A part of a proof that a differential equation y'' = r y has no Liouvillian
    solution: its linear algebra, and bounds of degrees. What is stated here is that
    polynomials of certain degrees do not exist, or that a degree is negative. Not stated
    are the equation, that these are the degrees and the equations of such polynomials
    (Kovacic 1986, Ulmer and Weil 1996), nor what follows for integrals. *)
From Coq Require Import QArith List Bool Setoid.
Import ListNotations.
Open Scope Q_scope.
Arguments Qred : simpl never.
Arguments Qplus : simpl never.
Arguments Qmult : simpl never.

(** Vectors: lists of rational numbers, the missing ones zero. *)
Fixpoint vadd (a b : list Q) : list Q :=
  match a, b with
  | [], _ => b
  | _, [] => a
  | x :: s, y :: t => Qred (x + y) :: vadd s t
  end.
Definition vscale (k : Q) (a : list Q) : list Q := map (fun x => Qred (k * x)) a.
Fixpoint dot (l a : list Q) : Q :=
  match l, a with
  | x :: s, y :: t => Qred (x * y + dot s t)
  | _, _ => 0
  end.
(** c1 times the first vector plus c2 times the second plus .. *)
Fixpoint combination (c : list Q) (vectors : list (list Q)) : list Q :=
  match c, vectors with
  | k :: s, v :: t => vadd (vscale k v) (combination s t)
  | _, _ => []
  end.
Definition zero (v : list Q) : Prop := Forall (fun x => x == 0) v.

Lemma dot_vadd : forall l a b, dot l (vadd a b) == dot l a + dot l b.
Proof.
  induction l as [|x l IH]; intros a b; simpl.
  - destruct (vadd a b); reflexivity.
  - destruct a as [|y a]; destruct b as [|z b]; cbn [vadd dot]; rewrite ?Qred_correct;
      try ring.
    rewrite IH; ring.
Qed.
Lemma dot_vscale : forall l k a, dot l (vscale k a) == k * dot l a.
Proof.
  induction l as [|x l IH]; intros k a; destruct a as [|y a]; cbn [vscale map dot];
    rewrite ?Qred_correct; try ring.
  change (map (fun x0 => Qred (k * x0)) a) with (vscale k a); rewrite IH; ring.
Qed.
Lemma dot_zero : forall l v, zero v -> dot l v == 0.
Proof.
  induction l as [|x l IH]; intros v H; destruct H as [|y v Hy Hv]; simpl; try reflexivity.
  rewrite Qred_correct, Hy, (IH v Hv); ring.
Qed.

(** l is orthogonal to all vectors but number n, and not to that one. *)
Fixpoint tells (l : list Q) (n : nat) (vectors : list (list Q)) : bool :=
  match vectors, n with
  | [], _ => false
  | v :: t, O => negb (Qeq_bool (dot l v) 0) && forallb (fun w => Qeq_bool (dot l w) 0) t
  | v :: t, S m => Qeq_bool (dot l v) 0 && tells l m t
  end.
Lemma dot_orthogonal : forall l vectors c,
  forallb (fun w => Qeq_bool (dot l w) 0) vectors = true -> dot l (combination c vectors) == 0.
Proof.
  induction vectors as [|v t IH]; intros c H; destruct c as [|k c]; simpl;
    try (destruct l; reflexivity).
  simpl in H; apply andb_true_iff in H; destruct H as [Hv Ht]; apply Qeq_bool_eq in Hv.
  rewrite dot_vadd, dot_vscale, Hv, (IH c Ht); ring.
Qed.
Lemma tells_dot : forall l vectors n c, tells l n vectors = true ->
  exists d, ~ d == 0 /\ dot l (combination c vectors) == nth n c 0 * d.
Proof.
  induction vectors as [|v t IH]; intros n c H; [destruct n; discriminate|].
  destruct n as [|m]; simpl in H; apply andb_true_iff in H; destruct H as [Hv Ht].
  - exists (dot l v); split.
    + intro E; apply Qeq_bool_iff in E; rewrite E in Hv; discriminate.
    + destruct c as [|k c]; simpl; [destruct l; simpl; ring|].
      rewrite dot_vadd, dot_vscale, (dot_orthogonal l t c Ht); ring.
  - apply Qeq_bool_eq in Hv; destruct c as [|k c].
    + destruct (IH m [] Ht) as [d [Hd _]]; exists d; split; [exact Hd|].
      simpl; destruct l; simpl; ring.
    + destruct (IH m c Ht) as [d [Hd E]]; exists d; split; [exact Hd|].
      simpl; rewrite dot_vadd, dot_vscale, Hv, E; ring.
Qed.
Theorem told : forall l n vectors c,
  tells l n vectors = true -> zero (combination c vectors) -> nth n c 0 == 0.
Proof.
  intros l n vectors c H Z; destruct (tells_dot l vectors n c H) as [d [Hd E]].
  rewrite (dot_zero l _ Z) in E; symmetry in E; apply Qmult_integral in E.
  destruct E as [E|E]; [exact E|contradiction].
Qed.
Fixpoint all_told (witnesses : list (list Q)) (n : nat) (vectors : list (list Q)) : bool :=
  match witnesses with
  | [] => true
  | l :: t => tells l n vectors && all_told t (S n) vectors
  end.
Lemma all_told_each : forall witnesses first vectors n,
  all_told witnesses first vectors = true -> (n < length witnesses)%nat ->
  tells (nth n witnesses []) (first + n) vectors = true.
Proof.
  induction witnesses as [|l t IH]; intros first vectors n H L; simpl in L; [inversion L|].
  simpl in H; apply andb_true_iff in H; destruct H as [Hl Ht].
  destruct n as [|n]; simpl.
  - rewrite Nat.add_0_r; exact Hl.
  - rewrite Nat.add_succ_r, <- Nat.add_succ_l; apply IH; [exact Ht|].
    apply Nat.succ_lt_mono; exact L.
Qed.

(** Polynomials in z: their coefficients from degree 0 on. *)
Definition pscale := vscale.
Fixpoint pmul (a b : list Q) : list Q :=
  match a with
  | [] => []
  | x :: s => vadd (vscale x b) (0 :: pmul s b)
  end.
Fixpoint derivative_from (n : Z) (a : list Q) : list Q :=
  match a with
  | [] => []
  | x :: s => Qred (inject_Z n * x) :: derivative_from (n + 1) s
  end.
Definition derivative (a : list Q) : list Q :=
  match a with [] => [] | _ :: s => derivative_from 1 s end.
Fixpoint monomial (n : nat) : list Q := match n with O => [1] | S m => 0 :: monomial m end.
Fixpoint monomials (n : nat) : list (list Q) :=
  match n with O => [] | S m => monomials m ++ [monomial m] end.

(** a P'' + b P' + c P *)
Definition second_order (a b c p : list Q) : list Q :=
  vadd (pmul a (derivative (derivative p))) (vadd (pmul b (derivative p)) (pmul c p)).

(** The recursion of a symmetric power. *)
Fixpoint power_recursion (g slope logarithmic squared : list Q) (m : Z) (i : nat)
    (above current : list Q) : list Q :=
  match i with
  | O => current
  | S j =>
    let k := Z.of_nat j in
    let rest := vadd logarithmic (vscale (- inject_Z (m - k)) slope) in
    let next := vscale (-1) (vadd (vadd (pmul g (derivative current)) (pmul rest current))
                      (vscale (inject_Z ((m - k) * (k + 1))) (pmul squared above))) in
    power_recursion g slope logarithmic squared m j current next
  end.
Definition symmetric_power (g slope logarithmic squared : list Q) (m : nat) (p : list Q) : list Q :=
  power_recursion g slope logarithmic squared (Z.of_nat m) (S m) [] (vscale (-1) p).
)coq";

}  // namespace casimir::obstruction
