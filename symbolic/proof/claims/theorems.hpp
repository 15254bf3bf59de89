#pragma once

namespace casimir {

class CertificateWriter;
struct Statement;

/// What a certificate states of a claim, beside the claims in their files: each defines what the
/// claim is about and writes its theorems. Nothing is written where one of these is thrown.
/// \throws NotCovered, TooLarge
/// {
void certify_skew(CertificateWriter& writer, const Statement& statement);
void certify_jacobi(CertificateWriter& writer, const Statement& statement);
void certify_casimir(CertificateWriter& writer, const Statement& statement);
void certify_integral(CertificateWriter& writer, const Statement& statement);
void certify_conditional(CertificateWriter& writer, const Statement& statement);
void certify_invariant_relation(CertificateWriter& writer, const Statement& statement);
/// }

}  // namespace casimir
