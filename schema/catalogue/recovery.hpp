// What a program that was killed, or a copy that was made of one file of two, has left of a
// catalogue.
#pragma once

#include <string>

namespace misalign::schema {

/// Leaves one plain file: what a killed program has left half done is rolled back, and what is in
/// its log folded in. UserError as from Catalogue's constructor, whatever campaign it holds.
void recover(const std::string& path);

/// The same where a journal to roll back lies beside the file, which a reader may not do: before a
/// verb reads what it will write. Waits while another process writes there.
void recover_before_writing(const std::string& path);

}  // namespace misalign::schema
